// SPDX-License-Identifier: MIT
#pragma once

#include <lua.hpp>
#include <memory>

namespace tunica::shell {

class Watchdog;

/// For as long as it lives, SIGINT, SIGTERM, SIGHUP and SIGUSR1 stop what Lua runs on this state, in two stages: the
/// cancel flag at once, so that kernel loops and the model's own loop stop between consistent states; and after 100 ms,
/// for Lua code that does not look at the flag, a hook that raises "interrupted" at every instruction until `calm`, so
/// that no pcall of a script can swallow it. What has not stopped after 2 s, such as a function of Lua's own that is
/// not done, never may: then a watchdog writes what the host of the state holds to be rescued (core.rescue), and 3 s
/// later it ends the program, unless an operation of the kernel is running, which will end. A second signal ends the program at once. One at a time.
class Interrupts {
 public:
  explicit Interrupts(lua_State* L);
  ~Interrupts();
  Interrupts(const Interrupts&) = delete;
  Interrupts& operator=(const Interrupts&) = delete;

  /// The number of the signal that came since the last `calm`, or 0.
  int signal() const;

  /// Takes the hook off and clears the flag; a signal from now on counts as the first again if `forget`.
  void calm(bool forget);

  /// At the prompt a signal only ends the line that is being typed: no hook, and a second one does not end the program.
  void at_prompt(bool waiting);

  /// For a session that goes on after an interruption: the hook raises its error in the user's own code only, so that
  /// the library can put its state in order (in the library too after many instructions, or a second); and it takes
  /// three signals to end the program at once, which then still rescues.
  void interactive(bool on);

 private:
  lua_State* lua_;
  std::unique_ptr<Watchdog> watchdog_;
};

/// What is to be done before a signal ends the program at once; it may only do what a signal handler may. None:
/// nothing.
void at_abrupt_end(void (*put_back)());

}  // namespace tunica::shell
