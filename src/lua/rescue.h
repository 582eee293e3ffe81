// SPDX-License-Identifier: MIT
#pragma once

#include <lua.hpp>
#include <map>
#include <mutex>
#include <string>
#include <string_view>

namespace tunica::lua {

/// A copy of the state at hand that can be written when Lua no longer can be asked, because a function of it does not
/// return: bytes that Lua holds, and the file they belong in. Written by another thread than Lua's.
class Rescue {
 public:
  /// Takes the table on top of the stack, which is popped: { path =, note =, bytes = } or { path =, note =, sections =
  /// name -> bytes }, or nil for nothing. Bytes are not copied.
  void set(lua_State* L);

  /// Writes the file as one act, once. Returns the note, what went wrong, or "" if there is nothing to write.
  std::string write();

 private:
  std::mutex mutex_;
  std::string path_, note_;
  bool written_ = false;
  std::map<std::string, std::string_view> parts_;  ///< "" alone: the whole content, no container
};

void register_rescue(lua_State* L);

}  // namespace tunica::lua
