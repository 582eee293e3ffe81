// SPDX-License-Identifier: MIT
#pragma once

#include <semaphore.h>

#include <atomic>
#include <thread>

#include "lua/rescue.h"

namespace tunica::shell {

/// A thread that saves and ends the program when what runs cannot be broken off. Its three orders may be given by a
/// signal handler.
class Watchdog {
 public:
  Watchdog();
  ~Watchdog();
  Watchdog(const Watchdog&) = delete;
  Watchdog& operator=(const Watchdog&) = delete;

  lua::Rescue& rescue() { return rescue_; }

  /// Writes what there is to rescue, and says so on standard error.
  void save() noexcept;
  /// The same, unless it has been done, and then ends the program with this code.
  void leave(int code) noexcept;
  /// What runs has stopped after all: a `leave` that is not yet carried out is void.
  void calm() noexcept;

 private:
  void work();

  lua::Rescue rescue_;
  sem_t orders_;
  std::atomic<int> order_{0}, code_{0};
  std::thread thread_;
};

}  // namespace tunica::shell
