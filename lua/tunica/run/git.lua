-- SPDX-License-Identifier: MIT
--- The revision of a script that is kept in git, read from git's own files: no program is called.

local core = require "tunica.core"

local git = {}

local function first_line(path)
  if core.kind_of(path) ~= "file" then return nil end
  return core.read_file(path):match "^[^\r\n]*"
end

local function join(folder, path) return path:sub(1, 1) == "/" and path or folder .. "/" .. path end

--- The folder of git's files for the work tree that `folder` is in, or nil. In a linked work tree `.git` is a file that
-- names it.
local function git_folder(folder)
  while true do
    local path = folder:gsub("/$", "") .. "/.git"
    local kind = core.kind_of(path)
    if kind == "folder" then return path end
    if kind == "file" then
      local named = (first_line(path) or ""):match "^gitdir: (.+)$"
      return named and join(folder, named)
    end
    if folder == "/" or folder == "" then return nil end
    folder = folder:match "^(.*)/[^/]*$"
  end
end

local function packed(folder, name)
  local path = folder .. "/packed-refs"
  if core.kind_of(path) ~= "file" then return nil end
  for line in core.read_file(path):gmatch "[^\r\n]+" do
    local hash, ref = line:match "^(%x+) (.+)$"
    if ref == name then return hash end
  end
end

local function revision(script)
  local own = git_folder(core.absolute_path(script):match "^(.*)/[^/]*$")
  if not own then return nil end
  -- Branches are common to all work trees of a repository; HEAD is each one's own.
  local common = first_line(own .. "/commondir")
  common = common and join(own, common) or own
  local value = first_line(own .. "/HEAD")
  for _ = 1, 5 do
    local name = value and value:match "^ref: (.+)$"
    if not name then break end
    value = first_line(own .. "/" .. name) or first_line(common .. "/" .. name) or packed(common, name)
  end
  return value and (#value == 40 or #value == 64) and value:match "^%x+$" or nil
end

--- The commit that is checked out where the script (a path) lies, or nil if it is no file in a git work tree.
function git.revision(script)
  if core.kind_of(script) ~= "file" then return nil end
  local ok, found = pcall(revision, script)
  return ok and found or nil
end

return git
