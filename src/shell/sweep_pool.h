// SPDX-License-Identifier: MIT
#pragma once

#include <sys/types.h>

#include <chrono>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace tunica::shell {

/// What a run may use.
struct RunLimits {
  double seconds = 3600;  ///< of wall clock
  double megabytes = 0;   ///< of the machine's memory; 0 = no limit
};

/// How a child ended.
struct Outcome {
  size_t job = 0;
  std::string status;   ///< done, failed, numerical, crashed, killed, time, memory
  std::string result;   ///< what it wrote, if it came to its end
  std::string files;    ///< those that it read, as JSON: path -> hash; "" if it did not come to tell
  std::string message;  ///< why not
  std::string log;      ///< last lines of its standard error and output
  double seconds = 0, cpu_seconds = 0, megabytes = 0;
};

/// What a child writes to its parent, which believes nothing that the script may have printed. The arguments are those
/// fields of an Outcome.
std::string answer_of(const std::string& status, const std::string& message, const std::string& result,
                      const std::string& files);

/// Local processes, a forked child for each run: it begins with what the parent has loaded, and whatever becomes of it
/// (a crash, endless loops, eaten memory) is an outcome. The parent has a single thread and runs no model. Children die
/// with their parent.
class Pool {
 public:
  /// `body(job, fd)` runs in the child and writes to the descriptor what became of it (answer_of); its return value is
  /// the exit code.
  using Body = std::function<int(size_t job, int descriptor)>;
  Pool(int processes, RunLimits limits, Body body);
  ~Pool();
  Pool(const Pool&) = delete;

  bool full() const { return children_.size() >= processes_; }
  bool empty() const { return children_.empty(); }
  void start(size_t job);
  /// The next child that has ended; nothing after `seconds` or when a signal came.
  std::optional<Outcome> wait(double seconds);
  /// Ends all children and forgets them.
  void stop();

 private:
  using Clock = std::chrono::steady_clock;
  struct Child {
    size_t job;
    pid_t process;
    int result, log;  ///< descriptors to read from
    Clock::time_point begun;
    std::string result_text, log_text;
    bool out_of_time = false, out_of_memory = false, ended = false, silent = false;
  };
  [[noreturn]] void run_child(size_t job, int result, int log);
  double keep_limits();
  void read(Child& child);
  Outcome end(Child& child);

  size_t processes_;
  RunLimits limits_;
  Body body_;
  std::vector<Child> children_;
};

}  // namespace tunica::shell
