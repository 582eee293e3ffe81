// SPDX-License-Identifier: MIT
#pragma once

#include <exception>
#include <lua.hpp>
#include <new>
#include <optional>
#include <string>
#include <utility>

#include "base/cancel.h"

namespace tunica::lua {

/// Where math.random stands: part of every checkpoint. Unless a script calls math.randomseed, the run's seed serves.
struct RandomStream {
  uint64_t seed = 0;
  uint64_t drawn = 0;
  bool seeded = false;
};

class Rescue;

/// What a terminal answered when it was asked what pictures it can show, once it was; keys that came meanwhile, to be
/// read next.
struct TerminalTalk {
  std::optional<std::string> answer;
  std::string typed;
};

/// What one Lua state knows of its host; lives as long as the state.
struct Host {
  CancelFlag cancel;
  uint64_t seed = 1;  ///< master seed of the run
  RandomStream random;
  const void* metatables[5] = {};  ///< of the handles (Kind) and of the tissue (last); see handle.h
  int tissues_made = 0;
  int rules = 0;                     ///< that are being called as they are, one inside another (see InRule)
  bool notes_errors = false;         ///< whether a function is to be told where errors are raised (see note_errors)
  TerminalTalk* terminal = nullptr;  ///< of a host that keeps what the terminal answered
  Rescue* rescue = nullptr;          ///< of a host that has one (see core.rescue)
  lua_State* main = nullptr;         ///< the thread that lives as long as the state
  lua_State* active = nullptr;       ///< the thread that runs an operation which may call back into Lua (see Entering)
};
Host& host(lua_State* L);

/// For the length of an operation: callbacks that the kernel keeps (a column's rule at division) run on this thread.
class Entering {
 public:
  explicit Entering(lua_State* L) : host_(host(L)), before_(std::exchange(host_.active, L)) {}
  ~Entering() { host_.active = before_; }
  Entering(const Entering&) = delete;

 private:
  Host& host_;
  lua_State* before_;
};

/// While a rule of a model is called as it is: it may compute, and set nothing but what it is given to set.
class InRule {
 public:
  explicit InRule(lua_State* L) : host_(host(L)) { ++host_.rules; }
  ~InRule() { --host_.rules; }
  InRule(const InRule&) = delete;

 private:
  Host& host_;
};

/// Whether a frame ("Sl" filled in) is of a script, not of the library, whose chunks are named "=tunica/...".
bool is_users_code(const lua_Debug& frame);

/// Pushes "file:line: " of the innermost frame in the user's own code (chunks named "=tunica/..." are the library's).
void push_where(lua_State* L);

/// Pushes an error message, cut where a value quoted in it is very long.
void push_message(lua_State* L, const char* message);

/// A Lua error caught on its way through C++ (a callback that failed): the very same value is handed on, so the user
/// sees the line of the callback, not of the operation that called it.
class ScriptError : public Error {
 public:
  /// Takes the error value from the top of the stack.
  explicit ScriptError(lua_State* L);
  void push(lua_State* L) const;

 private:
  int reference_;
};

/// An error that says itself where in the script it belongs, such as the place of a rule.
class Placed : public Error {
 public:
  using Error::Error;
};

/// The function on top of the stack, which is popped, becomes the message handler of `call`: at the prompt it notes the
/// frames in which an error is raised, since they are gone when the error comes out of the kernel.
void note_errors(lua_State* L);

/// Calls the function below its `arguments` on the stack; a Lua error comes back as a ScriptError.
void call(lua_State* L, int arguments, int results);

/// Whether an operation of the kernel runs, else Lua or a function of its own. A signal handler may ask.
inline thread_local volatile bool in_operation = false;

/// For its length that is so.
class Running {
 public:
  explicit Running(bool operation) : before_(in_operation) { in_operation = operation; }
  ~Running() { in_operation = before_; }
  Running(const Running&) = delete;

 private:
  bool before_;
};

/// Runs `body`, turning any C++ exception into a Lua error with the script's file and line.
/// Lua errors raised inside pass through (they unwind C++ frames). Every function given to Lua is wrapped in this.
template <class Body>
int guard(lua_State* L, Body&& body) {
  const Running operation(true);
  try {
    return body();
  } catch (const ScriptError& error) {
    error.push(L);
  } catch (const std::bad_alloc&) {
    push_where(L);
    lua_pushstring(L, "out of memory");
    lua_concat(L, 2);
  } catch (const Placed& error) {
    push_message(L, error.what());
  } catch (const std::exception& error) {
    push_where(L);
    push_message(L, error.what());
    lua_concat(L, 2);
  }
  return lua_error(L);
}

/// Adds the functions of one area to the table on top of the stack (the module `tunica.core`).
void register_tissue(lua_State* L);
void register_model(lua_State* L);
void register_view(lua_State* L);
void register_apex_view(lua_State* L);
void register_run(lua_State* L);

}  // namespace tunica::lua
