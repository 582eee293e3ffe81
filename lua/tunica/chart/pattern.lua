-- SPDX-License-Identifier: MIT
--- The pattern of a column: its maxima. Two patterns are the same if as many are at the same places, or one cell beside.

local core = require "tunica.core"

local pattern = {}

local above_mean = 0.25  -- of the way from the mean to the greatest value: what is lower is no maximum

--- Identities of the cells with more of a column than every neighbour (of equal ones, the one with the lower identity), and
-- more than mean + 0.25 (max - mean).
function pattern.maxima(tissue, column)
  local ids, values = core.column_values(tissue, "cell", column)
  local of, sum, most = {}, 0, -math.huge
  for i, id in ipairs(ids) do
    of[id], sum, most = values[i], sum + values[i], math.max(most, values[i])
  end
  local mean = #ids > 0 and sum / #ids or 0
  local least, found = mean + above_mean * (most - mean), core.as_list {}
  for c in tissue:cells() do
    local id = c.id
    local value = of[id]
    local highest = value > least
    if highest then
      for n in c:neighbours() do
        local other = of[n.id]
        highest = highest and (value > other or value == other and id < n.id)
      end
    end
    if highest then found[#found + 1] = id end
  end
  return found
end

--- How the maxima of a tissue differ from those of a reference (lists of identities), in words; nil if they do not.
function pattern.difference(tissue, maxima, reference)
  if #maxima ~= #reference then return string.format("pattern: %d instead of %d maxima", #maxima, #reference) end
  local free, moved, elsewhere = {}, {}, 0
  for _, id in ipairs(reference) do free[id] = true end
  for _, id in ipairs(maxima) do
    if free[id] then free[id] = nil else moved[#moved + 1] = id end
  end
  for _, id in ipairs(moved) do
    local place
    for n in tissue:find(id):neighbours() do
      if free[n.id] then place = place or n.id end
    end
    if place then free[place] = nil else elsewhere = elsewhere + 1 end
  end
  if elsewhere > 0 then return string.format("pattern: %d of %d maxima elsewhere", elsewhere, #reference) end
end

return pattern
