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

constexpr std::array stopping = {SIGINT, SIGTERM, SIGHUP, SIGUSR1};
struct sigaction before[stopping.size()], before_alarm;

void stop_lua(lua_State* L, lua_Debug*) { luaL_error(L, "interrupted"); }

void set_alarm(long microseconds) {
  itimerval timer{};
  timer.it_value.tv_usec = microseconds;
  setitimer(ITIMER_REAL, &timer, nullptr);
}

void on_alarm(int) {
  if (pending && state) lua_sethook(state, stop_lua, LUA_MASKCALL | LUA_MASKRET | LUA_MASKCOUNT, 1);
}

void on_signal(int number) {
  if (waiting_at_prompt && number == SIGINT) {
    pending = number;
    return;
  }
  if (pending) {
    constexpr char text[] = "\nstopped at once by a second signal\n";
    if (write(STDERR_FILENO, text, sizeof text - 1) < 0) {
    }
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
  if (forget) pending = 0;
}

void Interrupts::at_prompt(bool waiting) { waiting_at_prompt = waiting; }

}  // namespace tunica::shell
