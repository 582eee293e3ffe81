-- SPDX-License-Identifier: MIT
--- The run directory: made whole, then filled; every file in it is replaced as one act.

local core = require "tunica.core"

local directory = {}

local function base_name(path) return path:match "([^/]+)/*$" or path end
local function folder_of(path) return path:match "^(.*)/[^/]*$" or "." end
directory.folder_of = folder_of

--- Whether a run may begin at this path; else why not.
function directory.refusal(path)
  local kind = core.kind_of(path)
  if kind == nil or kind == "folder" and #core.list(path) == 0 then return nil end
  if kind ~= "folder" then return string.format("'%s' exists and is not a folder", path) end
  local remedy = core.kind_of(path .. "/run.json") and string.format(", or continue it: tunica resume %s", path) or ""
  return string.format("'%s' exists and is not empty; choose another --out%s", path, remedy)
end

--- Makes the run directory with its first content as one act. `fill(folder)` writes into a hidden folder beside it,
-- which then gets its name; nobody ever sees half of it. `path` nil: the next free runs/<name>-<n>.
function directory.make(path, name, fill)
  local parent = path and folder_of(path) or "runs"
  core.mkdir(parent)
  local hidden = string.format("%s/.%s.new-%d", parent, base_name(path or name), core.process_id())
  core.remove_all(hidden)
  core.mkdir(hidden)
  local filled, message = pcall(fill, hidden)
  if not filled then
    core.remove_all(hidden)
    error(message, 0)
  end
  for n = 1, path and 1 or 100000 do
    local try = path or string.format("runs/%s-%d", name, n)
    if directory.refusal(try) == nil and (path or core.kind_of(try) == nil) then
      local ok, why = pcall(core.rename, hidden, try)
      if ok then return try end
      message = why
    end
  end
  core.remove_all(hidden)
  error(message or directory.refusal(path), 0)
end

local lock = "/.lock"

--- Whether this process alone works in the run directory from now on, until it ends; else why not.
function directory.lock(folder)
  if core.lock_file(folder .. lock) then return true end
  local _, holder = pcall(core.read_file, folder .. lock)
  holder = tostring(holder):match "^(%d+)\n$"
  return false, string.format("'%s' is in use: %s is running it", folder, holder and "process " .. holder or "another process")
end

--- A path within the script's folder `home` as seen from there; else nil.
local function within(home, path)
  local inside = path:sub(1, #home) == home and path:sub(#home + 1)
  return inside and inside:sub(1, 1) ~= "/" and not inside:find("..", 1, true) and inside or nil
end

--- Where the copy of a source goes under <folder>/script; and the name under which a run from there must be told of it,
-- where it would not look for it by itself.
local function place_of(source, home)
  local inside = within(home, source.path)
  if source.asked then
    local held = inside and inside:match "^files/"  -- a copy already: the run is one that is repeated
    local copy = inside or "files/" .. core.hash(source.text) .. "-" .. base_name(source.path)
    return copy, not (inside and source.beside and not held) and source.asked or nil
  end
  if source.path:match "%.lua$" then return inside or base_name(source.path) end
  return base_name(source.path):gsub("[^%w_-]", "") .. ".lua"
end

--- Copies of the sources under <folder>/script, so that the run can be repeated when the originals have changed.
-- `main`: path of the script as it was loaded. Returns { main = entry, modules = { entry, ... }, files = { entry, ... } },
-- an entry being { path = original, copy = "script/...", hash = }; of files also `asked`, the name by which the script
-- asks for one that does not lie in its folder.
function directory.save_sources(folder, main)
  local found, seen = { modules = core.as_list {}, files = core.as_list {} }, {}
  local home = folder_of(main) == "." and "" or folder_of(main) .. "/"
  for _, source in ipairs(core.sources()) do
    local key = (source.asked or "") .. "\0" .. source.path
    if not seen[key] then
      seen[key] = true
      local copy, asked = place_of(source, home)
      local entry = { path = core.absolute_path(source.path), copy = "script/" .. copy, hash = core.hash(source.text),
        asked = asked }
      core.mkdir(folder_of(folder .. "/" .. entry.copy))
      core.write_atomic(folder .. "/" .. entry.copy, source.text)
      if source.asked then found.files[#found.files + 1] = entry
      elseif source.path == main then found.main = entry
      else found.modules[#found.modules + 1] = entry end
    end
  end
  return found
end

-- Checkpoints ------------------------------------------------------------------------------------------------------

local newest, previous = "/checkpoint.bin", "/checkpoint.previous.bin"

--- Writes a checkpoint (sections by name) and keeps the one before. On a full disk both old ones stay.
function directory.write_checkpoint(folder, sections)
  core.write_atomic(folder .. newest .. ".new", core.pack(sections))
  if core.kind_of(folder .. newest) then core.rename(folder .. newest, folder .. previous) end
  core.rename(folder .. newest .. ".new", folder .. newest)
  return folder .. newest
end

--- The sections of the newest checkpoint that is whole, or nil; and a list of what was wrong with others.
function directory.read_checkpoint(folder)
  local complaints = {}
  for _, name in ipairs { newest, previous } do
    local path = folder .. name
    if core.kind_of(path) then
      local ok, sections = pcall(function() return core.unpack(core.read_file(path)) end)
      if ok then return sections, complaints, path end
      complaints[#complaints + 1] = string.format("%s: %s", path, sections)
    end
  end
  return nil, complaints
end

return directory
