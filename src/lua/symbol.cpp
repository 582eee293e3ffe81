// SPDX-License-Identifier: MIT
#include "lua/symbol.h"

#include <atomic>
#include <cstring>

#include "lua/bind_tissue.h"
#include "lua/guard.h"

namespace tunica::lua {

namespace {

constexpr const char* metatable = "tunica.symbol";
using View = Tracer::View;

struct Symbol {
  enum class Type : uint8_t { value, cell, wall, side, rates } type;
  View view;       // of a cell
  bool mirrored;   // a side seen from across
  NodeId node;     // of a value
  int frame;       // 0: scalar
  uint64_t trace;  // of the rule that it was made in; kept longer, it means nothing
};

constexpr const char* kept_too_long =
    "a symbol of a rule is used outside its rule; rules may only compute, not keep what they were given";

Symbol* symbol_at(lua_State* L, int at) {
  if (lua_type(L, at) != LUA_TUSERDATA || !lua_getmetatable(L, at)) return nullptr;
  luaL_getmetatable(L, metatable);
  const bool same = lua_rawequal(L, -1, -2);
  lua_pop(L, 2);
  return same ? static_cast<Symbol*>(lua_touserdata(L, at)) : nullptr;
}

Symbol* push(lua_State* L, Symbol::Type type, int frame, View view = View::here, bool mirrored = false,
             NodeId node = no_node) {
  auto* s = static_cast<Symbol*>(lua_newuserdata(L, sizeof(Symbol)));
  *s = {type, view, mirrored, node, frame, active_tracer(L)->trace};
  luaL_getmetatable(L, metatable);
  lua_setmetatable(L, -2);
  return s;
}

Tracer& tracer(lua_State* L) {
  Tracer* active = active_tracer(L);
  if (!active) fail("{}", kept_too_long);
  return *active;
}

void check_trace(const Tracer& t, const Symbol& s) {
  if (s.trace != t.trace) fail("{}", kept_too_long);
}

void push_value(lua_State* L, Tracer& t, NodeId node) {
  const Domain domain = t.equations->graph[node].domain;
  const int frame = domain == Domain::scalar ? 0 : domain == Domain::cell ? t.context.cell_frame : t.context.body_frame;
  push(L, Symbol::Type::value, frame, View::here, false, node);
}

void check_frame(const Tracer& t, const Symbol& s) {
  check_trace(t, s);
  if (s.frame == 0 || s.frame == t.context.cell_frame || s.frame == t.context.body_frame) return;
  fail("a sum within a sum uses a value of the outer one, which cannot be traced");
}

/// A number or symbol as a node.
NodeId node_at(lua_State* L, Tracer& t, int at) {
  if (const Symbol* s = symbol_at(L, at)) {
    if (s->type != Symbol::Type::value)
      fail("expected a number, got {} itself; name one of its columns", s->type == Symbol::Type::cell   ? "a cell"
                                                                        : s->type == Symbol::Type::wall ? "a wall"
                                                                                                        : "a side");
    check_frame(t, *s);
    return s->node;
  }
  if (lua_type(L, at) == LUA_TNUMBER) return t.equations->graph.constant(lua_tonumber(L, at));
  if (lua_type(L, at) == LUA_TBOOLEAN) return t.equations->graph.constant(lua_toboolean(L, at) ? 1.0 : 0.0);
  fail("expected a number, got {}", describe(L, at));
}

// === Arithmetic

template <Op op>
int binary(lua_State* L) {
  return guard(L, [&] {
    Tracer& t = tracer(L);
    const NodeId a = node_at(L, t, 1), b = node_at(L, t, 2);
    push_value(L, t, t.equations->graph.binary(op, a, b));
    return 1;
  });
}

int negate(lua_State* L) {
  return guard(L, [&] {
    Tracer& t = tracer(L);
    push_value(L, t, t.equations->graph.unary(Op::neg, node_at(L, t, 1)));
    return 1;
  });
}

int compare(lua_State* L) {
  return guard(L, [&]() -> int {
    fail(
        "a rule cannot decide by comparing values with <, <=, > or ==; write where(above(x, y), a, b), min, max, clamp "
        "or step");
  });
}

int refuse(lua_State* L) {
  return guard(
      L, [&]() -> int { fail("a rule's symbol cannot be called, measured or joined to text; rules only compute"); });
}

int to_text(lua_State* L) {
  lua_pushliteral(L, "a symbol of a rule");
  return 1;
}

// === Reading columns

NodeId from_view(Graph& g, NodeId node, View view) {
  return view == View::here ? node : view == View::own ? g.own(node) : g.across(node);
}

/// cell:sum(f), :minimum(f), :maximum(f): f(n, w, s, o) with the neighbour, the wall, and its two sides.
template <Op op>
int reduce(lua_State* L) {
  return guard(L, [&] {
    Tracer& t = tracer(L);
    Symbol* c = symbol_at(L, 1);
    if (!c || c->type != Symbol::Type::cell) fail("expected a cell before :sum, got {}", describe(L, 1));
    check_function(L, 2, "the function to sum");
    check_frame(t, *c);
    const Tracer::Context outside = t.context;
    const Symbol before = *c;
    // The body sees this cell as its own; what belongs to an enclosing body is out of sight.
    t.context.cell_frame = c->view == View::here ? c->frame : ++t.frames;
    t.context.body_frame = ++t.frames;
    c->frame = t.context.cell_frame;
    c->view = View::here;
    NodeId body = no_node;
    ++t.sums;
    const auto restore = [&] {
      --t.sums;
      *c = before;
      t.context = outside;
    };
    try {
      lua_pushvalue(L, 2);
      const int frame = t.context.body_frame;
      push(L, Symbol::Type::cell, frame, View::across);
      push(L, Symbol::Type::wall, frame);
      push(L, Symbol::Type::side, frame);
      push(L, Symbol::Type::side, frame, View::here, true);
      call(L, 4, 1);
      body = node_at(L, t, -1);
      lua_pop(L, 1);
    } catch (...) {
      restore();
      throw;
    }
    Graph& g = t.equations->graph;
    const NodeId total = from_view(g, g.reduce(op, body), before.view);
    restore();
    push_value(L, t, total);
    return 1;
  });
}

bool push_method(lua_State* L, const std::string& name) {
  if (name == "sum") return lua_pushcfunction(L, reduce<Op::sum>), true;
  if (name == "minimum") return lua_pushcfunction(L, reduce<Op::minimum>), true;
  if (name == "maximum") return lua_pushcfunction(L, reduce<Op::maximum>), true;
  return false;
}

int index_cell(lua_State* L, Tracer& t, const Symbol& c, const std::string& name) {
  if (push_method(L, name)) return 1;
  Graph& g = t.equations->graph;
  const NodeId node = name == "valence" ? g.column(Kind::cell, -1) : t.read(Kind::cell, name);
  push_value(L, t, from_view(g, node, c.view));
  return 1;
}

int index_side(lua_State* L, Tracer& t, const Symbol& s, const std::string& name) {
  if (name == "cell") return push(L, Symbol::Type::cell, s.frame, s.mirrored ? View::across : View::own), 1;
  if (name == "neighbour") return push(L, Symbol::Type::cell, s.frame, s.mirrored ? View::own : View::across), 1;
  if (name == "wall") return push(L, Symbol::Type::wall, s.frame), 1;
  if (name == "opposite") return push(L, Symbol::Type::side, s.frame, View::here, !s.mirrored), 1;
  const NodeId node = t.read(Kind::side, name);
  push_value(L, t, s.mirrored ? t.equations->graph.mirrored(node) : node);
  return 1;
}

Symbol::Type type_of(Kind kind) {
  return kind == Kind::cell ? Symbol::Type::cell : kind == Kind::side ? Symbol::Type::side : Symbol::Type::wall;
}

/// Whether the rule may set fields of this: `d`, or the element whose columns it derives.
bool is_subject(const Tracer& t, const Symbol& s) {
  if (s.type == Symbol::Type::rates) return true;
  if (!t.deriving || s.type != type_of(t.subject) || s.view != View::here || s.mirrored) return false;
  const int frame = s.type == Symbol::Type::cell ? t.context.cell_frame : t.context.body_frame;
  return s.frame == frame && (t.sums == 0 || s.type == Symbol::Type::cell);
}

int index(lua_State* L) {
  return guard(L, [&] {
    Tracer& t = tracer(L);
    const Symbol s = *symbol_at(L, 1);
    check_trace(t, s);
    if (s.type != Symbol::Type::value) check_frame(t, s);
    const std::string name = check_string(L, 2, "a column's name");
    if (s.type != Symbol::Type::rates && t.sums == 0 && is_subject(t, s))
      for (const auto& [column, node] : t.written)
        if (column == name) return push_value(L, t, node), 1;
    switch (s.type) {
      case Symbol::Type::cell:
        return index_cell(L, t, s, name);
      case Symbol::Type::side:
        return index_side(L, t, s, name);
      case Symbol::Type::wall:
        push_value(L, t, t.read(Kind::wall, name));
        return 1;
      case Symbol::Type::rates:
        for (const auto& [column, node] : t.written)
          if (column == name) return push_value(L, t, node), 1;
        fail("d.{} is read before it is set", name);
      case Symbol::Type::value:
        break;
    }
    fail("a number has no field '{}'", name);
  });
}

int assign(lua_State* L) {
  return guard(L, [&] {
    Tracer& t = tracer(L);
    const Symbol s = *symbol_at(L, 1);
    const std::string name = check_string(L, 2, "a column's name");
    check_trace(t, s);
    if (!is_subject(t, s))
      t.forbid(L,
               fmt::format("'{:.60}' cannot be set here: a derive rule sets columns of the element it is given, a rate "
                           "rule those of d",
                           name));
    try {
      require_settable(L, *t.tissue, t.subject, name);
    } catch (const Error& error) {
      t.forbid(L, error.what());
    }
    if (t.sums > 0) fail("'{}' is set inside a sum, which cannot be traced", name);
    const NodeId node = node_at(L, t, 3);
    for (auto& [column, old] : t.written)
      if (column == name) return old = node, 0;
    t.written.emplace_back(name, node);
    return 0;
  });
}

// === Functions of numbers and symbols

template <Op op, int arguments>
int function(lua_State* L) {
  return guard(L, [&] {
    if (lua_gettop(L) < arguments)
      fail("expected {} argument{}, got {}", arguments, arguments == 1 ? "" : "s", lua_gettop(L));
    bool symbolic = false;
    for (int i = 1; i <= arguments; ++i) symbolic = symbolic || symbol_at(L, i);
    if (symbolic) {
      Tracer& t = tracer(L);
      Graph& g = t.equations->graph;
      NodeId x[3] = {no_node, no_node, no_node};
      for (int i = 0; i < arguments; ++i) x[i] = node_at(L, t, i + 1);
      push_value(L, t,
                 op == Op::select ? g.select(x[0], x[1], x[2])
                 : arguments == 1 ? g.unary(op, x[0])
                                  : g.binary(op, x[0], x[1]));
      return 1;
    }
    double x[3] = {0, 0, 0};
    for (int i = 0; i < arguments; ++i)
      x[i] = lua_isboolean(L, i + 1) ? lua_toboolean(L, i + 1) : check_number(L, i + 1, "a number or a rule's value");
    lua_pushnumber(L, apply(op, x[0], x[1], x[2]));
    return 1;
  });
}

/// min and max of one or more.
template <Op op>
int extreme(lua_State* L) {
  return guard(L, [&] {
    const int n = lua_gettop(L);
    if (n < 1) fail("expected one or more numbers, got none");
    lua_settop(L, n);
    lua_pushvalue(L, 1);
    for (int i = 2; i <= n; ++i) {
      lua_pushcfunction(L, (function<op, 2>));
      lua_insert(L, -2);
      lua_pushvalue(L, i);
      call(L, 2, 1);
    }
    if (n == 1 && !symbol_at(L, 1)) check_number(L, 1, "a number or a rule's value");
    return 1;
  });
}

int parameter_symbol(lua_State* L) {
  return guard(L, [&] {
    Tracer* t = active_tracer(L);
    if (!t) return 0;
    const std::string name = check_string(L, 1, "a parameter's name");
    push_value(L, *t, t->equations->graph.parameter(t->equations->parameter_slot(name)));
    return 1;
  });
}

char tracer_key;

struct Active {
  Active(lua_State* L, Tracer* t) : slot(active_tracer(L)), before(slot) { slot = t; }
  ~Active() { slot = before; }
  Tracer*& slot;
  Tracer* before;
};

void push_time(lua_State* L, Tracer& t) { push_value(L, t, t.equations->graph.time()); }

}  // namespace

Tracer*& active_tracer(lua_State* L) {
  lua_pushlightuserdata(L, &tracer_key);
  lua_rawget(L, LUA_REGISTRYINDEX);
  auto* slot = static_cast<Tracer**>(lua_touserdata(L, -1));
  lua_pop(L, 1);
  if (!slot) fail("internal: the symbols are not registered");
  return *slot;
}

bool is_symbol(lua_State* L, int at) { return symbol_at(L, at) != nullptr; }

NodeId Tracer::read(Kind kind, const std::string& name) {
  if (const auto known = derived.find({kind, name}); known != derived.end()) return known->second;
  tissue->column(kind, name);  // the error for an unknown one
  return equations->graph.column(kind, equations->column_slot(kind, name));
}

void Tracer::forbid(lua_State* L, const std::string& message) {
  if (fault.empty()) {
    push_where(L);
    fault = lua_tostring(L, -1) + message;
    lua_pop(L, 1);
  }
  fail("{}", message);
}

void Tracer::begin(Kind of, bool derives) {
  static std::atomic<uint64_t> traces{0};
  trace = ++traces;
  context = {++frames, ++frames};
  written.clear();
  fault.clear();
  subject = of;
  deriving = derives;
  sums = 0;
}

Assignments Tracer::trace_derive(lua_State* L, Kind kind) {
  const Active active(L, this);
  begin(kind, true);
  int arguments = 0;
  if (kind == Kind::cell) {
    push(L, Symbol::Type::cell, context.cell_frame), ++arguments;
  } else {
    push(L, kind == Kind::side ? Symbol::Type::side : Symbol::Type::wall, context.body_frame), ++arguments;
    if (kind == Kind::wall) {
      push(L, Symbol::Type::cell, context.body_frame, View::own);
      push(L, Symbol::Type::cell, context.body_frame, View::across);
      arguments += 2;
    }
  }
  push_time(L, *this);
  call(L, arguments + 1, 0);
  return written;
}

Assignments Tracer::trace_rate(lua_State* L, Kind kind) {
  const Active active(L, this);
  begin(kind, false);
  push(L, type_of(kind), kind == Kind::cell ? context.cell_frame : context.body_frame);
  push(L, Symbol::Type::rates, kind == Kind::cell ? context.cell_frame : context.body_frame);
  int arguments = 2;
  if (kind == Kind::wall) {
    push(L, Symbol::Type::cell, context.body_frame, View::own);
    push(L, Symbol::Type::cell, context.body_frame, View::across);
    arguments += 2;
  }
  push_time(L, *this);
  call(L, arguments + 1, 0);
  return written;
}

Assignments Tracer::trace_flux(lua_State* L) {
  const Active active(L, this);
  begin(Kind::wall, false);
  push(L, Symbol::Type::wall, context.body_frame);
  push(L, Symbol::Type::cell, context.body_frame, View::own);
  push(L, Symbol::Type::cell, context.body_frame, View::across);
  push_time(L, *this);
  call(L, 4, 1);
  const NodeId value = node_at(L, *this, -1);
  lua_pop(L, 1);
  return {{"", value}};
}

NodeId Tracer::trace_field(lua_State* L) {
  const Active active(L, this);
  begin(Kind::side, false);
  push_value(L, *this, equations->graph.column(Kind::side, 0));
  push_value(L, *this, equations->graph.column(Kind::cell, 0));
  push_time(L, *this);
  call(L, 3, 1);
  const NodeId value = node_at(L, *this, -1);
  lua_pop(L, 1);
  return value;
}

void register_symbols(lua_State* L) {
  lua_pushlightuserdata(L, &tracer_key);
  auto** slot = static_cast<Tracer**>(lua_newuserdata(L, sizeof(Tracer*)));
  *slot = nullptr;
  lua_rawset(L, LUA_REGISTRYINDEX);

  luaL_newmetatable(L, metatable);
  const luaL_Reg events[] = {{"__add", binary<Op::add>}, {"__sub", binary<Op::sub>}, {"__mul", binary<Op::mul>},
                             {"__div", binary<Op::div>}, {"__pow", binary<Op::pow>}, {"__unm", negate},
                             {"__eq", compare},          {"__lt", compare},          {"__le", compare},
                             {"__concat", refuse},       {"__len", refuse},          {"__call", refuse},
                             {"__mod", refuse},          {"__index", index},         {"__newindex", assign},
                             {"__tostring", to_text},    {nullptr, nullptr}};
  add_functions(L, events);
  lua_pushboolean(L, 0);
  lua_setfield(L, -2, "__metatable");
  lua_pop(L, 1);

  const luaL_Reg functions[] = {
      {"exp", function<Op::exp, 1>},     {"log", function<Op::log, 1>},      {"sqrt", function<Op::sqrt, 1>},
      {"sin", function<Op::sin, 1>},     {"cos", function<Op::cos, 1>},      {"tanh", function<Op::tanh, 1>},
      {"abs", function<Op::abs, 1>},     {"pow", function<Op::pow, 2>},      {"min", extreme<Op::min>},
      {"max", extreme<Op::max>},         {"below", function<Op::less, 2>},   {"at_most", function<Op::less_equal, 2>},
      {"equal", function<Op::equal, 2>}, {"where", function<Op::select, 3>}, {nullptr, nullptr}};
  lua_newtable(L);
  add_functions(L, functions);
  lua_setfield(L, -2, "functions");
  lua_pushcfunction(L, parameter_symbol);
  lua_setfield(L, -2, "parameter_symbol");
}

}  // namespace tunica::lua
