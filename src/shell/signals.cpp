// SPDX-License-Identifier: MIT
#include "shell/signals.h"

#include <sys/time.h>
#include <unistd.h>

#include <array>
#include <csignal>
#include <cstring>

#include "base/cancel.h"
#include "lua/guard.h"

namespace tunica::shell {

namespace {

// A signal handler can reach nothing but variables like these.
lua_State* volatile state = nullptr;
CancelFlag* volatile flag = nullptr;
volatile std::sig_atomic_t pending = 0;
volatile std::sig_atomic_t waiting_at_prompt = 0;
volatile std::sig_atomic_t goes_on = 0;  // a prompt
volatile std::sig_atomic_t presses = 0;  // since the last calm
volatile std::sig_atomic_t alarms = 0;
void (*volatile put_back_first)() = nullptr;

constexpr std::array stopping = {SIGINT, SIGTERM, SIGHUP, SIGUSR1};
struct sigaction before[stopping.size()], before_alarm;

void stop_lua(lua_State* L, lua_Debug*) { luaL_error(L, "interrupted"); }

void stop_users_code(lua_State* L, lua_Debug* frame) {
  if (lua_getinfo(L, "Sl", frame) && lua::is_users_code(*frame)) luaL_error(L, "interrupted");
}

void set_alarm(long microseconds) {
  itimerval timer{};
  timer.it_value.tv_usec = microseconds;
  setitimer(ITIMER_REAL, &timer, nullptr);
}

void on_alarm(int) {
  if (!pending || !state) return;
  const bool only_users = goes_on && alarms == 0;
  alarms = alarms + 1;
  lua_sethook(state, only_users ? stop_users_code : stop_lua, LUA_MASKCALL | LUA_MASKRET | LUA_MASKCOUNT, 1);
  if (only_users) set_alarm(900000);
}

void say(const char* text) {
  if (write(STDERR_FILENO, text, std::strlen(text)) < 0) {
  }
}

void on_signal(int number) {
  if (waiting_at_prompt && number == SIGINT) {
    pending = number;
    return;
  }
  presses = presses + 1;
  if (pending && goes_on && number == SIGINT && presses < 3) {
    say("\nstill stopping: what runs cannot be broken off at once; Ctrl-C once more ends the program\n");
    return;
  }
  if (pending) {
    if (put_back_first) put_back_first();
    say("\nstopped at once by a second signal\n");
    _exit(128 + number);
  }
  pending = number;
  if (flag) flag->request();
  set_alarm(100000);
}

void install(int number, void (*handler)(int), struct sigaction* old) {
  struct sigaction action {};
  action.sa_handler = handler;
  sigemptyset(&action.sa_mask);
  // No SA_RESTART: a script that waits for input must come back. Our own reads and writes start again by themselves.
  sigaction(number, &action, old);
}

}  // namespace

Interrupts::Interrupts(lua_State* L) {
  pending = 0;
  state = L;
  flag = &lua::host(L).cancel;
  install(SIGALRM, on_alarm, &before_alarm);
  for (size_t i = 0; i < stopping.size(); ++i) install(stopping[i], on_signal, &before[i]);
}

Interrupts::~Interrupts() {
  for (size_t i = 0; i < stopping.size(); ++i) sigaction(stopping[i], &before[i], nullptr);
  set_alarm(0);
  sigaction(SIGALRM, &before_alarm, nullptr);
  state = nullptr;
  flag = nullptr;
}

int Interrupts::signal() const { return pending; }

void Interrupts::calm(bool forget) {
  set_alarm(0);
  lua_sethook(state, nullptr, 0, 0);
  flag->clear();
  if (forget) {
    pending = 0;
    presses = 0;
  }
  alarms = 0;
}

void Interrupts::interactive(bool on) { goes_on = on; }

void Interrupts::at_prompt(bool waiting) { waiting_at_prompt = waiting; }

void at_abrupt_end(void (*put_back)()) { put_back_first = put_back; }

}  // namespace tunica::shell
