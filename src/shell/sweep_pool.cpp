// SPDX-License-Identifier: MIT
#include "shell/sweep_pool.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <exception>
#include <new>
#include <nlohmann/json.hpp>

#include "base/error.h"
#include "base/files.h"
#include "shell/exit_codes.h"

namespace tunica::shell {

namespace {

constexpr size_t most_log = 4096;  // bytes kept of what a run says
constexpr size_t most_result = size_t{16} << 20;
constexpr int result_descriptor = 3;    // in a child
constexpr double between_looks = 0.05;  // seconds; at the memory of children

/// Memory that a process has in the machine's. Its address space says nothing: columns reserve much of it and use
/// little.
double megabytes_of(pid_t process) {
  const std::string path = fmt::format("/proc/{}/statm", process);
  FILE* file = std::fopen(path.c_str(), "re");
  if (!file) return 0;
  long pages = 0;
  if (std::fscanf(file, "%*d %ld", &pages) != 1) pages = 0;
  std::fclose(file);
  return static_cast<double>(pages) * static_cast<double>(sysconf(_SC_PAGESIZE)) / 1048576;
}

/// If the machine runs out of memory, a run is to end and not the sweep.
void be_first_without_memory() {
  const int file = open("/proc/self/oom_score_adj", O_WRONLY | O_CLOEXEC);
  if (file < 0) return;
  if (write(file, "1000", 4) != 4) errno = 0;
  close(file);
}

void default_signals() {
  for (const int number : {SIGINT, SIGTERM, SIGHUP, SIGUSR1, SIGALRM, SIGPIPE}) std::signal(number, SIG_DFL);
}

void move(int from, int to) {
  if (from == to) return;
  dup2(from, to);
}

/// The last lines, no more than `most_log` bytes.
std::string last_lines(std::string text) {
  if (text.size() > most_log) {
    text.erase(0, text.size() - most_log);
    text.erase(0, text.find('\n') + 1);
  }
  while (!text.empty() && text.back() == '\n') text.pop_back();
  return text;
}

bool write_answer(int descriptor, const std::string& text) {
  return write(descriptor, text.data(), text.size()) == static_cast<ssize_t>(text.size());
}

/// Takes a child's answer apart. False if it is none.
bool read_answer(std::string& answer, Outcome& outcome) {
  const size_t end = answer.find('\n');
  if (end == std::string::npos) return false;
  const auto head = nlohmann::json::parse(answer.substr(0, end), nullptr, false);
  if (!head.is_object() || !head.contains("status") || !head.contains("message")) return false;
  outcome.status = head.at("status");
  outcome.message = head.at("message");
  outcome.files = head.value("files", "");
  outcome.result = answer.substr(end + 1);
  return true;
}

}  // namespace

std::string answer_of(const std::string& status, const std::string& message, const std::string& result,
                      const std::string& files) {
  const nlohmann::json head{{"status", status}, {"message", message}, {"files", files}};
  return head.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace) + "\n" + result;
}

Pool::Pool(int processes, RunLimits limits, Body body)
    : processes_(std::max(processes, 1)), limits_(limits), body_(std::move(body)) {}

Pool::~Pool() { stop(); }

void Pool::run_child(size_t job, int result, int log) {
  setpgid(0, 0);  // a Ctrl-C at the terminal is the parent's; a time limit ends what the run has started too
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (getppid() == 1) _exit(1);
  default_signals();
  const int nothing = open("/dev/null", O_RDONLY);
  move(nothing, STDIN_FILENO);
  move(log, STDOUT_FILENO);
  move(log, STDERR_FILENO);
  move(result, result_descriptor);
  close_range(result_descriptor + 1, ~0U, 0);  // locks, the database, other children's pipes
  fcntl(result_descriptor, F_SETFD, FD_CLOEXEC);
  const rlimit no_core{0, 0};
  setrlimit(RLIMIT_CORE, &no_core);
  be_first_without_memory();
  int code = script_error;
  try {
    code = body_(job, result_descriptor);
  } catch (const std::bad_alloc&) {
    const char answer[] = "{\"status\":\"memory\",\"message\":\"out of memory\"}\n";
    if (write(result_descriptor, answer, sizeof answer - 1) < 0) code = script_error;
  } catch (const std::exception& error) {
    if (!write_answer(result_descriptor, answer_of("failed", error.what(), "", ""))) code = file_error;
  }
  std::fflush(nullptr);
  _exit(code);  // nothing of the parent's is to be closed or written
}

void Pool::start(size_t job) {
  int result[2], log[2];
  if (pipe2(result, O_CLOEXEC) != 0) fail("cannot start a run: {}", std::strerror(errno));
  if (pipe2(log, O_CLOEXEC) != 0) {
    const int reason = errno;
    close(result[0]);
    close(result[1]);
    fail("cannot start a run: {}", std::strerror(reason));
  }
  std::fflush(nullptr);
  const auto begun = Clock::now();
  const pid_t process = fork();
  if (process == 0) run_child(job, result[1], log[1]);
  const int reason = errno;
  close(result[1]);
  close(log[1]);
  if (process < 0) {
    close(result[0]);
    close(log[0]);
    fail("cannot start a run: {}", std::strerror(reason));
  }
  for (const int descriptor : {result[0], log[0]}) fcntl(descriptor, F_SETFL, O_NONBLOCK);
  children_.push_back({job, process, result[0], log[0], begun, {}, {}});
}

/// Takes what the child has written. The result's end is the child's, since nobody else holds that pipe.
void Pool::read(Child& child) {
  char bytes[16384];
  ssize_t count = 0;
  for (int k = 0; k < 16 && (count = ::read(child.log, bytes, sizeof bytes)) > 0; ++k) {
    child.log_text.append(bytes, count);
    if (child.log_text.size() > 64 * most_log) child.log_text.erase(0, child.log_text.size() - 32 * most_log);
  }
  if (count == 0) child.silent = true;
  while ((count = ::read(child.result, bytes, sizeof bytes)) > 0)
    if (child.result_text.size() < most_result) child.result_text.append(bytes, count);
  if (count == 0) child.ended = true;
}

Outcome Pool::end(Child& child) {
  int status = 0;
  rusage usage{};
  while (wait4(child.process, &status, 0, &usage) < 0 && errno == EINTR) {
  }
  kill(-child.process, SIGKILL);  // what the run may have started
  read(child);
  close(child.result);
  close(child.log);
  const auto seconds = [](const timeval& t) {
    return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
  };
  Outcome outcome{.job = child.job, .log = last_lines(child.log_text)};
  outcome.seconds = std::chrono::duration<double>(Clock::now() - child.begun).count();
  outcome.cpu_seconds = seconds(usage.ru_utime) + seconds(usage.ru_stime);
  outcome.megabytes = static_cast<double>(usage.ru_maxrss) / 1024;
  if (child.out_of_memory) {
    outcome.status = "memory";
    outcome.message = fmt::format("more than the limit of {:.0f} MB", limits_.megabytes);
  } else if (child.out_of_time) {
    outcome.status = "time";
    outcome.message = fmt::format("not done after {:g} s", limits_.seconds);
  } else if (WIFSIGNALED(status)) {
    const int number = WTERMSIG(status);
    outcome.status = number == SIGKILL ? "killed" : "crashed";
    outcome.message = number == SIGKILL ? "ended from outside by SIGKILL; so does a machine without memory"
                                        : fmt::format("ended by signal {} ({})", number, strsignal(number));
  } else if (child.result_text.size() >= most_result) {
    outcome.status = "failed";
    outcome.message = fmt::format("the report is larger than {} MB", most_result >> 20);
  } else if (!read_answer(child.result_text, outcome) || (outcome.status == "done" && WEXITSTATUS(status) != ok)) {
    outcome.status = "failed";
    outcome.message = fmt::format("ended with exit code {} and without an answer", WEXITSTATUS(status));
  }
  return outcome;
}

/// Ends children that are beyond a limit. Returns the seconds until the next look.
double Pool::keep_limits() {
  double next = limits_.megabytes > 0 ? between_looks : 60;
  for (auto& child : children_) {
    const double left = limits_.seconds - std::chrono::duration<double>(Clock::now() - child.begun).count();
    child.out_of_time = child.out_of_time || left <= 0;
    child.out_of_memory =
        child.out_of_memory || (limits_.megabytes > 0 && megabytes_of(child.process) > limits_.megabytes);
    if (child.out_of_time || child.out_of_memory) {
      kill(-child.process, SIGKILL);
      kill(child.process, SIGKILL);
    } else {
      next = std::min(next, left);
    }
  }
  return next;
}

std::optional<Outcome> Pool::wait(double seconds) {
  const auto until = Clock::now() + std::chrono::duration<double>(seconds);
  for (;;) {
    for (auto child = children_.begin(); child != children_.end(); ++child) {
      if (!child->ended) continue;
      Outcome outcome = end(*child);
      children_.erase(child);
      return outcome;
    }
    const auto time = Clock::now();
    if (time >= until || children_.empty()) return std::nullopt;
    auto next = std::chrono::duration<double>(until - time).count();
    next = std::min(next, keep_limits());
    std::vector<pollfd> watched;
    for (const auto& child : children_) {
      watched.push_back({child.result, POLLIN, 0});
      if (!child.silent) watched.push_back({child.log, POLLIN, 0});
    }
    const int ready = poll(watched.data(), watched.size(), static_cast<int>(std::min(next, 60.0) * 1000) + 1);
    if (ready < 0) {
      if (errno == EINTR) return std::nullopt;
      fail("cannot wait for runs: {}", std::strerror(errno));
    }
    if (ready > 0)
      for (auto& child : children_) read(child);
  }
}

void Pool::stop() {
  for (auto& child : children_) {
    kill(-child.process, SIGKILL);
    kill(child.process, SIGKILL);
  }
  for (auto& child : children_) {
    while (waitpid(child.process, nullptr, 0) < 0 && errno == EINTR) {
    }
    close(child.result);
    close(child.log);
  }
  children_.clear();
}

}  // namespace tunica::shell
