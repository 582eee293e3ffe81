// SPDX-License-Identifier: MIT
#include "view/spawn.h"

#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>

extern char** environ;

namespace tunica {
namespace {

/// Attributes and redirections of the process; freed on every way out.
struct SpawnPlan {
  posix_spawnattr_t attributes;
  posix_spawn_file_actions_t actions;
  SpawnPlan() {
    posix_spawnattr_init(&attributes);
    posix_spawn_file_actions_init(&actions);
  }
  ~SpawnPlan() {
    posix_spawnattr_destroy(&attributes);
    posix_spawn_file_actions_destroy(&actions);
  }
};

}  // namespace

pid_t spawn(const std::vector<std::string>& command, int input, int messages) {
  SpawnPlan plan;
  sigset_t every, nothing;
  sigfillset(&every);
  sigemptyset(&nothing);
  posix_spawnattr_setsigdefault(&plan.attributes, &every);
  posix_spawnattr_setsigmask(&plan.attributes, &nothing);
  posix_spawnattr_setpgroup(&plan.attributes, 0);
  posix_spawnattr_setflags(&plan.attributes, POSIX_SPAWN_SETSIGDEF | POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETPGROUP);
  posix_spawn_file_actions_adddup2(&plan.actions, input, 0);
  posix_spawn_file_actions_adddup2(&plan.actions, messages, 1);
  posix_spawn_file_actions_adddup2(&plan.actions, messages, 2);
  std::vector<char*> arguments;
  for (const std::string& word : command) arguments.push_back(const_cast<char*>(word.c_str()));
  arguments.push_back(nullptr);
  pid_t child = -1;
  const int error = posix_spawnp(&child, arguments[0], &plan.actions, &plan.attributes, arguments.data(), environ);
  return error ? -error : child;
}

bool wait_for(pid_t process, const CancelFlag* cancel) {
  int status = 0;
  // A signal between a look at the flag and a wait for ever would be lost, so it is looked at again and again.
  for (long microseconds = 500; cancel && waitpid(process, &status, WNOHANG) == 0;) {
    if (cancel->requested()) {
      kill(-process, SIGKILL);
      cancel = nullptr;
    }
    usleep(static_cast<useconds_t>(microseconds));
    microseconds = std::min(2 * microseconds, 10000L);
    if (!cancel) break;
  }
  while (waitpid(process, &status, 0) < 0 && errno == EINTR) {
  }
  return WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

}  // namespace tunica
