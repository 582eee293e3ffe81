-- SPDX-License-Identifier: MIT
--- The conditions of a model (model:when): asked after each step, and located within it. `refresh(model's inside)` brings the
-- derived columns up to date; `stepping(inside, function, ...)` calls a function of the kernel that takes steps.

local core = require "tunica.core"

local conditions = {}

--- Conditions that have become true: their events happen now.
function conditions.test(my, now, refresh)
  if #my.conditions == 0 then return end
  refresh(my)
  for _, condition in ipairs(my.conditions) do
    local holds = condition.test(now) and true or false
    local becomes = holds and not condition.holds
    condition.holds = holds
    if becomes then condition.fn(now) end
  end
end

--- Whether a condition whose time is to be found has become true in the state that the tissue holds.
local function any_becomes(my, time, refresh)
  local any = false
  for _, condition in ipairs(my.conditions) do any = any or condition.located and not condition.holds end
  if not any then return false end
  refresh(my)
  for _, condition in ipairs(my.conditions) do
    if condition.located and not condition.holds and condition.test(time) then return true end
  end
  return false
end

--- Ends the last step where the first condition becomes true in it: found by bisection on the interpolated state; then
-- the step is taken anew, so that no error of interpolation stays. (Where the state so reached does not fulfil it yet,
-- a little later.)
function conditions.locate(my, refresh, stepping)
  local machine = my.machine
  local first, last = core.last_step(machine)
  if not first or not any_becomes(my, last, refresh) then return end
  local function holds_at(time)
    core.show(machine, time)
    return any_becomes(my, time, refresh)
  end
  local low, high = first, last
  local near = 1e-9 * (last - first)
  local ok, message = pcall(function()
    if holds_at(first) then high = last return end  -- not because of this step
    while high - low > near do
      local middle = low + (high - low) / 2
      if middle <= low or middle >= high then return end
      if holds_at(middle) then high = middle else low = middle end
    end
  end)
  core.show(machine, last)
  if not ok then error(message, 0) end
  local on = near
  while high < last do
    local status = stepping(my, core.retake, high)
    if status ~= "done" then return status end
    if any_becomes(my, high, refresh) then return end
    on = 8 * on
    high = high + on
  end
  if select(2, core.last_step(machine)) < last then return stepping(my, core.retake, last) end
end

return conditions
