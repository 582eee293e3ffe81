// SPDX-License-Identifier: MIT
#include "lua/bind_tissue.h"

namespace tunica::lua {

void register_tissue(lua_State* L) {
  register_handles(L);
  register_elements(L);
  register_iteration(L);
  register_columns(L);
  register_builders(L);
  register_structure(L);
  register_division(L);
  register_growth(L);
  register_surfaces(L);
  register_apex_tissue(L);
  register_pattern(L);
}

}  // namespace tunica::lua
