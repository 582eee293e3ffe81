// SPDX-License-Identifier: MIT
#include "shell/watchdog.h"

#include <fmt/format.h>
#include <pthread.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>

namespace tunica::shell {

namespace {

enum Order { nothing, to_save, to_leave, to_end };

void say(const std::string& text) {
  if (write(STDERR_FILENO, text.data(), text.size()) < 0) {
  }
}

}  // namespace

Watchdog::Watchdog() {
  sem_init(&orders_, 0, 0);
  // Signals are for the thread that runs Lua: the handlers set hooks on its state.
  sigset_t every, before;
  sigfillset(&every);
  pthread_sigmask(SIG_BLOCK, &every, &before);
  thread_ = std::thread([this] { work(); });
  pthread_sigmask(SIG_SETMASK, &before, nullptr);
}

Watchdog::~Watchdog() {
  order_ = to_end;
  sem_post(&orders_);
  thread_.join();
  sem_destroy(&orders_);
}

void Watchdog::save() noexcept {
  order_ = to_save;
  sem_post(&orders_);
}

void Watchdog::leave(int code) noexcept {
  code_ = code;
  order_ = to_leave;
  sem_post(&orders_);
}

void Watchdog::calm() noexcept {
  order_ = nothing;
  sem_post(&orders_);
}

void Watchdog::work() {
  bool said = false;
  for (;;) {
    while (sem_wait(&orders_) != 0 && errno == EINTR) {
    }
    const int order = order_;
    if (order == to_end) return;
    if (order == nothing) {
      said = false;
      continue;
    }
    const std::string note = rescue_.write();
    if (!said) say(fmt::format("\nwhat runs cannot be broken off{}{}\n", note.empty() ? "" : ". ", note));
    said = true;
    if (order_ != to_leave) continue;
    say("tunica ends\n");
    _exit(code_);
  }
}

}  // namespace tunica::shell
