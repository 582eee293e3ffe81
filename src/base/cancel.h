// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>

#include "base/error.h"

namespace tunica {

/// Set by the host (from a signal handler, another thread) to stop what runs; polled by long operations between
/// consistent states. The library installs no signal handler itself.
class CancelFlag {
 public:
  void request() noexcept { requested_.store(true, std::memory_order_relaxed); }
  void clear() noexcept { requested_.store(false, std::memory_order_relaxed); }
  bool requested() const noexcept { return requested_.load(std::memory_order_relaxed); }

 private:
  std::atomic<bool> requested_{false};
  static_assert(std::atomic<bool>::is_always_lock_free, "a signal handler must be able to set the flag");
};

/// Thrown when a cancel request is honoured; the state is consistent.
class Cancelled : public Error {
 public:
  Cancelled() : Error("interrupted") {}
};

inline void poll(const CancelFlag* flag) {
  if (flag && flag->requested()) throw Cancelled();
}

}  // namespace tunica
