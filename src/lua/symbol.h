// SPDX-License-Identifier: MIT
#pragma once

#include <lua.hpp>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "base/error.h"
#include "rule/equations.h"
#include "tissue/tissue.h"

namespace tunica::lua {

/// What one call of a rule with symbols wrote: column names with their nodes, in the order first written.
using Assignments = std::vector<std::pair<std::string, NodeId>>;

/// Calls rules with symbols in place of numbers and notes what they compute. One at a time per Lua state.
///
/// Symbols carry the frame they belong to: the cell of the rule, or the body of a sum over neighbours. A value of
/// another frame cannot be used, so that a sum within a sum never mistakes one cell for another.
class Tracer {
 public:
  enum class View : uint8_t { here, own, across };  ///< a cell: of a cell rule; of a side; across a side

  Tracer(std::shared_ptr<Equations> e, std::shared_ptr<Tissue> t) : equations(std::move(e)), tissue(std::move(t)) {}

  /// Calls the function on top of the stack (popped) with symbols. Errors: ScriptError or Error with the reason.
  /// derive: f(c, t), or for sides f(s, t), for walls f(w, a, b, t);
  /// rate: f(c, d, t), f(s, d, t), f(w, d, a, b, t). flux: returns its value in Assignments under "".
  Assignments trace_derive(lua_State* L, Kind kind);
  Assignments trace_rate(lua_State* L, Kind kind);
  Assignments trace_flux(lua_State* L);
  /// A field f(d, age, t) of one primordium: its value, with d as side column 0 and age as cell column 0.
  NodeId trace_field(lua_State* L);

  std::shared_ptr<Equations> equations;
  std::shared_ptr<Tissue> tissue;
  std::map<std::pair<Kind, std::string>, NodeId> derived;  ///< columns whose values are expressions

  // --- for the symbols
  struct Context {
    int cell_frame, body_frame;
  };
  Context context{0, 0};
  int frames = 0;
  uint64_t trace = 0;  ///< the rule's call with symbols that is under way: another number for each in this process
  bool deriving = false;
  Kind subject = Kind::cell;  ///< what the rule is for
  int sums = 0;               ///< that are being traced, one inside another
  Assignments written;
  std::string fault;  ///< what the rule did that no rule may, with its place; stays even if the rule catches the error

  /// Throws an error that the rule cannot escape by being run as it is: see fault.
  [[noreturn]] void forbid(lua_State* L, const std::string& message);

  /// A column's value as a side or cell node; derived columns by their expression. Errors: unknown column.
  NodeId read(Kind kind, const std::string& name);

 private:
  void begin(Kind of, bool derives);
};

/// True if the value at `at` is a symbol of any kind.
bool is_symbol(lua_State* L, int at);

/// Adds to the module on top of the stack: `functions`, those of rules (exp, where, ...), which take numbers and
/// symbols, and `parameter_symbol(name)`.
void register_symbols(lua_State* L);

/// The tracer at work in this state, or null.
Tracer*& active_tracer(lua_State* L);

}  // namespace tunica::lua
