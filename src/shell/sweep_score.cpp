// SPDX-License-Identifier: MIT
#include "shell/sweep_score.h"

#include "base/error.h"

namespace tunica::shell {

namespace {

/// Pushes a function of tunica.sweep.score.
void push_function(lua_State* L, const char* name) {
  lua_getglobal(L, "require");
  lua_pushstring(L, "tunica.sweep.score");
  if (const auto error = lua::call_protected(L, 1, 1)) fail("{}", *error);
  lua_getfield(L, -1, name);
  lua_remove(L, -2);
}

/// A parameter's own value with its type.
void push_value(lua_State* L, const sweep::Parameter& p) {
  using Type = sweep::Parameter::Type;
  lua_pushlstring(L, p.value.data(), p.value.size());
  if (p.type == Type::text) return;
  const double number = p.type == Type::number ? lua_tonumber(L, -1) : 0;
  lua_pop(L, 1);
  p.type == Type::number ? lua_pushnumber(L, number) : lua_pushboolean(L, p.value == "true");
}

constexpr int most_millions = 50;  // of Lua's instructions; some tenths of a second

void refuse_to_go_on(lua_State* L, lua_Debug*) {
  lua_pushfstring(L, "the score runs for more than %d million instructions; does it end?", most_millions);
  lua_error(L);
}

std::string first_line(const std::string& text) { return text.substr(0, text.find('\n')); }

}  // namespace

Scorer::Scorer(Session& session, const std::string& expression, const Description& about) : session_(session) {
  lua_State* L = session.lua();
  push_function(L, "compile");
  lua_pushlstring(L, expression.data(), expression.size());
  lua_createtable(L, static_cast<int>(about.reports.size()), 0);
  for (size_t i = 0; i < about.reports.size(); ++i) {
    lua_pushstring(L, about.reports[i].c_str());
    lua_rawseti(L, -2, static_cast<int>(i) + 1);
  }
  lua_newtable(L);
  for (const auto& p : about.parameters) {
    push_value(L, p);
    lua_setfield(L, -2, p.name.c_str());
  }
  if (const auto error = lua::call_protected(L, 3, 1)) throw UsageError{first_line(*error)};
  compiled_ = luaL_ref(L, LUA_REGISTRYINDEX);
}

Scorer::~Scorer() { luaL_unref(session_.lua(), LUA_REGISTRYINDEX, compiled_); }

Score Scorer::operator()(const std::string& result, const Values& values) {
  lua_State* L = session_.lua();
  session_.interrupts().calm(false);  // a signal that has come is not to break off what follows
  push_function(L, "of");
  lua_rawgeti(L, LUA_REGISTRYINDEX, compiled_);
  lua_pushlstring(L, result.data(), result.size());
  lua_newtable(L);
  for (const auto& [name, value] : values) {
    lua_pushlstring(L, value.data(), value.size());
    lua_setfield(L, -2, name.c_str());
  }
  lua_sethook(L, refuse_to_go_on, LUA_MASKCOUNT, most_millions * 1'000'000);
  const auto error = lua::call_protected(L, 3, 2);
  if (lua_gethook(L) == refuse_to_go_on) lua_sethook(L, nullptr, 0, 0);  // else a signal has set its own
  if (error) return {std::nullopt, first_line(*error)};
  Score score;
  if (lua_type(L, -2) == LUA_TNUMBER)
    score.value = lua_tonumber(L, -2);
  else
    score.why = lua_tostring(L, -1) ? lua_tostring(L, -1) : "no score";
  lua_pop(L, 2);
  return score;
}

}  // namespace tunica::shell
