-- SPDX-License-Identifier: MIT
-- Every block of share/doc/from-vv.md runs by itself, and there is one for each construct of the thesis's table 9.1.
local folder = debug.getinfo(1, "S").source:match "^@(.*/)" or "./"
local file = assert(io.open(folder .. "../../share/doc/from-vv.md"))
local text = file:read "*a"
file:close()

for _, construct in ipairs {
  "vertex v", "mesh S", "S.x", "v$x", "v^n", "(v^n).x", "forall v in S {...}", "forall n in v {...}", "nextto n in v",
  "prevto n in v", "splice a after n in v", "splice a before n in v", "make {a,b,c} nb_of v", "valence v",
} do
  assert(text:find("| `" .. construct .. "` |", 1, true), construct .. " has no row in the table")
end

local blocks = 0
for block in text:gmatch "```lua\n(.-)```" do
  blocks = blocks + 1
  assert(load(block, "=from-vv.md, block " .. blocks))()
end
assert(blocks >= 12, "only " .. blocks .. " blocks")
