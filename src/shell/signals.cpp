// SPDX-License-Identifier: MIT
#include "shell/signals.h"

#include <sys/time.h>
#include <unistd.h>

#include <array>
#include <csignal>
#include <cstring>

#include "base/cancel.h"
#include "lua/guard.h"
#include "shell/watchdog.h"

namespace tunica::shell {

namespace {

// A signal handler can reach nothing but variables like these.
lua_State* volatile state = nullptr;
CancelFlag* volatile flag = nullptr;
Watchdog* volatile watchdog = nullptr;
volatile std::sig_atomic_t pending = 0;
volatile std::sig_atomic_t waiting_at_prompt = 0;
volatile std::sig_atomic_t goes_on = 0;  // a prompt
volatile std::sig_atomic_t presses = 0;  // since the last calm
volatile std::sig_atomic_t alarms = 0;
void (*volatile put_back_first)() = nullptr;
volatile std::sig_atomic_t library_steps = 0;  // instructions of the library since the last error of the hook

constexpr std::array stopping = {SIGINT, SIGTERM, SIGHUP, SIGUSR1};
struct sigaction before[stopping.size()], before_alarm;

void stop_lua(lua_State* L, lua_Debug*) { luaL_error(L, "interrupted"); }

/// The library gets so many instructions to put its state in order: far more than that takes, and done in some 20 ms.
constexpr int most_library_steps = 200000;

void stop_users_code(lua_State* L, lua_Debug* frame) {
  const bool users = lua_getinfo(L, "Sl", frame) && lua::is_users_code(*frame);
  library_steps = library_steps + 1;
  if (!users && library_steps <= most_library_steps) return;
  library_steps = 0;
  luaL_error(L, "interrupted");
}

void set_alarm(double seconds) {
  itimerval timer{};
  timer.it_value.tv_sec = static_cast<time_t>(seconds);
  timer.it_value.tv_usec = static_cast<suseconds_t>((seconds - static_cast<double>(timer.it_value.tv_sec)) * 1e6);
  setitimer(ITIMER_REAL, &timer, nullptr);
}

void set_hook(lua_Hook hook) { lua_sethook(state, hook, LUA_MASKCALL | LUA_MASKRET | LUA_MASKCOUNT, 1); }

/// What there is to rescue is written, and the program ends.
void leave(int code) {
  if (put_back_first) put_back_first();
  watchdog->leave(code);
}

/// The stages of a stop, 0.1, 1, 2 and 5 s after the signal.
void on_alarm(int) {
  if (!pending || !state) return;
  alarms = alarms + 1;
  switch (alarms) {
    case 1:
      set_hook(goes_on ? stop_users_code : stop_lua);
      return set_alarm(0.9);
    case 2:
      set_hook(stop_lua);
      return set_alarm(1);
    case 3:
      watchdog->save();
      return set_alarm(3);
    default:
      // The kernel's own operations end: one that does not poll the flag goes on until it has, or the user has enough.
      if (lua::in_operation) return;
      leave(128 + pending);
  }
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
  if (pending && goes_on && number == SIGINT) {
    if (presses > 2) return leave(128 + number);
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
  set_alarm(0.1);
}

void install(int number, void (*handler)(int), struct sigaction* old) {
  struct sigaction action {};
  action.sa_handler = handler;
  sigemptyset(&action.sa_mask);
  // No SA_RESTART: a script that waits for input must come back. Our own reads and writes start again by themselves.
  sigaction(number, &action, old);
}

}  // namespace

Interrupts::Interrupts(lua_State* L) : lua_(L), watchdog_(std::make_unique<Watchdog>()) {
  pending = 0;
  state = L;
  flag = &lua::host(L).cancel;
  lua::host(L).rescue = &watchdog_->rescue();
  watchdog = watchdog_.get();
  install(SIGALRM, on_alarm, &before_alarm);
  for (size_t i = 0; i < stopping.size(); ++i) install(stopping[i], on_signal, &before[i]);
}

Interrupts::~Interrupts() {
  for (size_t i = 0; i < stopping.size(); ++i) sigaction(stopping[i], &before[i], nullptr);
  set_alarm(0);
  sigaction(SIGALRM, &before_alarm, nullptr);
  lua::host(lua_).rescue = nullptr;
  state = nullptr;
  flag = nullptr;
  watchdog = nullptr;
}

int Interrupts::signal() const { return pending; }

void Interrupts::calm(bool forget) {
  set_alarm(0);
  lua_sethook(state, nullptr, 0, 0);
  flag->clear();
  if (alarms > 2 || presses > 2) watchdog->calm();
  if (forget) {
    pending = 0;
    presses = 0;
  }
  alarms = 0;
  library_steps = 0;
}

void Interrupts::interactive(bool on) { goes_on = on; }

void Interrupts::at_prompt(bool waiting) { waiting_at_prompt = waiting; }

void at_abrupt_end(void (*put_back)()) { put_back_first = put_back; }

}  // namespace tunica::shell
