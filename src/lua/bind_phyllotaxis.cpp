// SPDX-License-Identifier: MIT
// Phyllotaxis by inhibition fields: what lua/tunica/phyllotaxis.lua runs. Angles are in radians here.
#include "lua/bind_phyllotaxis.h"

#include <cmath>

#include "lua/bind_shape.h"
#include "lua/guard.h"

namespace tunica::lua {

namespace {

/// A Lua function of numbers that the engine calls while it works; it can change nothing meanwhile.
class Callback {
 public:
  Callback(lua_State* L, int at) : host_(host(L)) {
    lua_pushvalue(L, at);
    reference_ = std::shared_ptr<const int>(new int(luaL_ref(L, LUA_REGISTRYINDEX)), [main = host_.main](const int* r) {
      luaL_unref(main, LUA_REGISTRYINDEX, *r);
      delete r;
    });
  }
  /// Calls it and leaves `results` values on the stack of the thread at work.
  lua_State* call_with(std::initializer_list<double> arguments, int results) const {
    lua_State* now = host_.active ? host_.active : host_.main;
    if (!lua_checkstack(now, 16)) fail("too many calls inside each other");
    lua_rawgeti(now, LUA_REGISTRYINDEX, *reference_);
    for (const double x : arguments) lua_pushnumber(now, x);
    const InRule in_rule(now);
    call(now, static_cast<int>(arguments.size()), results);
    return now;
  }
  double number(const char* what, std::initializer_list<double> arguments) const {
    lua_State* now = call_with(arguments, 1);
    if (lua_type(now, -1) != LUA_TNUMBER) fail("{} must be a number, came {}", what, describe(now, -1));
    const double value = lua_tonumber(now, -1);
    lua_pop(now, 1);
    return value;
  }
  Vec2 point(const char* what, double argument) const {
    lua_State* now = call_with({argument}, 2);
    const Vec2 p(lua_tonumber(now, -2), lua_tonumber(now, -1));
    if (lua_type(now, -2) != LUA_TNUMBER || lua_type(now, -1) != LUA_TNUMBER || std::isnan(p.x()) || std::isnan(p.y()))
      fail("{} must be two numbers x, y, came {} and {} for {:.6g}", what, describe(now, -2), describe(now, -1),
           argument);
    lua_pop(now, 2);
    return p;
  }

 private:
  Host& host_;
  std::shared_ptr<const int>
      reference_;  // lives in the objects of this Lua state, which collects them before it closes
};

/// A field that could not be traced.
class DirectField : public FieldRule {
 public:
  explicit DirectField(Callback f) : f_(std::move(f)) {}
  void add(double age, double t, const double* d, int count, double* h) override {
    for (int i = 0; i < count; ++i) h[i] += at(d[i], age, t);
  }
  double at(double d, double age, double t) override { return f_.number("a field", {d, age, t}); }

 private:
  Callback f_;
};

double number_field(lua_State* L, const char* name) {
  lua_getfield(L, 1, name);
  const double value = check_number(L, -1, name);
  lua_pop(L, 1);
  return value;
}

std::optional<Callback> function_field(lua_State* L, const char* name) {
  lua_getfield(L, 1, name);
  std::optional<Callback> f;
  if (lua_isfunction(L, -1)) f.emplace(L, lua_gettop(L));
  lua_pop(L, 1);
  return f;
}

/// The ring at an arc length of an apex, and the way of what starts there.
void ring_on_apex(InhibitionSettings& s, const Apex& apex, double arc) {
  constexpr double passages = 40;  // the way is tabulated until the ring's speed would have led so many radii away
  s.ring = apex.profile().at(arc);
  const double speed = apex.speed(arc);
  if (!(speed > 0))
    fail(
        "what is on the ring (arc {:.6g}) does not move away from the tip: the growth up to there is {:.6g}; give a "
        "place farther down by 'arc', or a rate of growth that is positive on the way there",
        arc, speed);
  // As far back as places are numbers: growth may be far quicker further down.
  double oldest = passages * s.ring.x() / speed;
  const auto reachable = [&](double age) {
    try {
      return apex.after(arc, age) < 1e12 * s.ring.x();
    } catch (const Error&) {
      return false;
    }
  };
  while (!reachable(oldest)) oldest /= 2;
  s.track = [path = apex.path(arc, oldest)](double age) -> Vec2 {
    try {
      return path.at(age);
    } catch (const Error&) {
      return {1e100, 0};  // so old that its place is beyond all numbers
    }
  };
  s.displaced = [apex, arc](double along) { return apex.profile().at(std::max(0.0, arc + along)); };
}

/// inhibition { apex, arc | radius, height, track = function(age) -> x, y; samples, ... } -> object, radius, height
int inhibition(lua_State* L) {
  return guard(L, [&] {
    check_table(L, 1, "the settings");
    const Entering entering(L);
    InhibitionSettings s;
    lua_getfield(L, 1, "apex");
    if (!lua_isnil(L, -1)) {
      ring_on_apex(s, apex_at(L, -1), number_field(L, "arc"));
    } else {
      const auto track = function_field(L, "track");
      if (!track) fail("the path must be a function(age) that returns x, y");
      s.ring = {number_field(L, "radius"), number_field(L, "height")};
      s.track = [f = *track](double age) { return f.point("the path", age); };
    }
    lua_pop(L, 1);
    s.samples = static_cast<int>(number_field(L, "samples"));
    s.jugacy = static_cast<int>(number_field(L, "jugacy"));
    s.tie = number_field(L, "tie");
    s.tolerance = number_field(L, "tolerance");
    s.longest_step = number_field(L, "dt");
    lua_getfield(L, 1, "located");
    s.located = lua_toboolean(L, -1);
    lua_pop(L, 1);
    s.drop = number_field(L, "drop");
    s.most_active = static_cast<int>(number_field(L, "most"));
    s.jitter_angle = number_field(L, "jitter_angle");
    s.jitter_along = number_field(L, "jitter_along");
    if (s.jitter_along > 0 && !s.displaced) fail("jitter along the profile needs the profile of an apex");
    s.seed = host(L).seed;
    s.cancel = &host(L).cancel;
    auto object = std::make_unique<Phyllotaxis>();
    const Vec2 ring = s.ring;
    object->engine = std::make_unique<Inhibition>(std::move(s));
    push_object(L, std::move(object));
    lua_pushnumber(L, ring.x());
    lua_pushnumber(L, ring.y());
    return 3;
  });
}

/// A traced field; or nothing, and the reason is left on the stack.
std::unique_ptr<FieldRule> traced(lua_State* L, int function, int parameters) {
  const int top = lua_gettop(L);
  auto equations = std::make_shared<Equations>();
  Tracer tracer(equations, nullptr);
  try {
    lua_pushvalue(L, function);
    const NodeId root = tracer.trace_field(L);
    auto rule = std::make_unique<TracedField>(equations->graph, root);
    rule->set_parameters(parameter_values(L, parameters, *equations));
    return rule;
  } catch (const ScriptError& error) {
    lua_settop(L, top);
    error.push(L);
  } catch (const Error& error) {
    lua_settop(L, top);
    lua_pushstring(L, error.what());
  }
  return nullptr;
}

/// inhibition_field(engine, k, function, threshold, parameters, direct) -> true, or false and why the function cannot
/// be traced. k: which, from 1; one more than there are adds one.
int field(lua_State* L) {
  return guard(L, [&] {
    Inhibition& engine = engine_at(L, 1);
    const Entering entering(L);
    const auto k = static_cast<size_t>(check_integer(L, 2, "which", 1, static_cast<int64_t>(engine.fields()) + 1)) - 1;
    check_function(L, 3, "a field");
    check_table(L, 5, "the parameters");
    InhibitionField made;
    if (lua_toboolean(L, 6)) {
      made.rule = std::make_unique<DirectField>(Callback(L, 3));
    } else {
      made.rule = traced(L, 3, 5);
      if (!made.rule) {
        lua_pushboolean(L, 0);
        lua_insert(L, -2);
        return 2;
      }
    }
    if (lua_type(L, 4) == LUA_TNUMBER) {
      made.threshold = [value = check_number(L, 4, "a threshold")](double) { return value; };
    } else {
      check_function(L, 4, "a threshold");
      made.threshold = [f = Callback(L, 4)](double t) { return f.number("a threshold", {t}); };
    }
    made.rule_varies = lua_toboolean(L, 7);
    made.varies = made.rule_varies || lua_isfunction(L, 4);
    if (k == engine.fields())
      engine.add_field(std::move(made));
    else
      engine.field(k) = std::move(made), engine.changed();
    lua_pushboolean(L, 1);
    return 1;
  });
}

/// inhibition_reconsider(engine): thresholds may have changed
int reconsider(lua_State* L) {
  return guard(L, [&] {
    engine_at(L, 1).reconsider();
    return 0;
  });
}

int changed(lua_State* L) {
  return guard(L, [&] {
    engine_at(L, 1).changed();
    return 0;
  });
}

/// inhibition_share(engine, k, d, age, t) -> the field of one primordium, as it is computed
int share(lua_State* L) {
  return guard(L, [&] {
    Inhibition& engine = engine_at(L, 1);
    const Entering entering(L);
    const size_t k = field_at(L, 2, engine);
    lua_pushnumber(L, engine.field(k).rule->at(lua_tonumber(L, 3), lua_tonumber(L, 4), lua_tonumber(L, 5)));
    return 1;
  });
}

}  // namespace

size_t field_at(lua_State* L, int at, const Inhibition& engine) {
  return static_cast<size_t>(
             check_integer(L, at, "the number of an inhibition", 1, static_cast<int64_t>(engine.fields()))) -
         1;
}

void register_phyllotaxis(lua_State* L) {
  const luaL_Reg functions[] = {{"inhibition", inhibition},      {"inhibition_field", field},
                                {"inhibition_changed", changed}, {"inhibition_reconsider", reconsider},
                                {"inhibition_share", share},     {nullptr, nullptr}};
  add_functions(L, functions);
  register_phyllotaxis_course(L);
}

}  // namespace tunica::lua
