// SPDX-License-Identifier: MIT
#include "lua/curve_files.h"

#include <cstring>
#include <filesystem>

#include "base/files.h"
#include "lua/bind_shape.h"
#include "lua/state.h"

namespace tunica::lua {

namespace {

namespace fs = std::filesystem;
constexpr const char* folder_key = "tunica.curves";
constexpr size_t largest_file = size_t{16} << 20;

fs::path curves_folder(lua_State* L) {
  lua_getfield(L, LUA_REGISTRYINDEX, folder_key);
  const fs::path folder = lua_isstring(L, -1) ? lua_tostring(L, -1) : "";
  lua_pop(L, 1);
  return folder;
}

/// The folder of the innermost file of the user's own that runs.
fs::path script_folder(lua_State* L) {
  lua_Debug frame;
  for (int level = 0; lua_getstack(L, level, &frame); ++level) {
    lua_getinfo(L, "S", &frame);
    if (frame.source[0] == '@') return fs::path(frame.source + 1).parent_path();
  }
  return "";
}

std::vector<std::string> shipped_names(const fs::path& folder, const char* ending) {
  std::vector<std::string> names;
  std::error_code error;
  for (fs::directory_iterator i(folder, error), end; !error && i != end; i.increment(error))
    if (i->path().extension() == ending) names.push_back(i->path().stem().string());
  std::sort(names.begin(), names.end());
  return names;
}

bool is_file(const fs::path& path) {
  std::error_code error;
  return fs::exists(path, error) && !fs::is_directory(path, error);
}

/// The shipped curve of a name, or "".
fs::path find_shipped(lua_State* L, const std::string& name, const char* ending) {
  const fs::path path = curves_folder(L) / (name + ending);
  return name.find('/') == std::string::npos && is_file(path) ? path : fs::path();
}

fs::path find_file(lua_State* L, const std::string& name, bool function) {
  const fs::path folder = curves_folder(L), in_script = script_folder(L) / name, copy = copy_of(L, name);
  const char* ending = function ? ".func" : ".con";
  if (!copy.empty() && is_file(copy) && (fs::path(name).is_absolute() || !is_file(in_script))) return copy;
  if (is_file(in_script)) return in_script;
  if (is_file(name)) return name;
  const auto names = shipped_names(folder, ending);
  std::string list;
  for (const std::string& known : names) list += (list.empty() ? "" : ", ") + known;
  const std::string hint = did_you_mean(name, names);
  fail("no {} and no file is called '{}'{}; shipped are {}", function ? "curve" : "contour", name.substr(0, 200), hint,
       list);
}

std::string titles(const std::vector<DrawnCurve>& curves) {
  std::string list;
  for (size_t i = 0; i < curves.size() && i < 20; ++i) list += (i ? ", " : "") + curves[i].name;
  return list;
}

}  // namespace

void set_curves_folder(lua_State* L, const std::string& library) {
  const fs::path beside = fs::path(library).parent_path();
  std::error_code error;
  const fs::path installed = beside / "curves", in_sources = beside / "share" / "curves";
  lua_pushstring(L, (fs::is_directory(installed, error) ? installed : in_sources).c_str());
  lua_setfield(L, LUA_REGISTRYINDEX, folder_key);
}

DrawnCurve find_curve(lua_State* L, const std::string& name, bool function, const std::string& item) {
  if (name.empty() || name.size() > 4096 || name.find('\0') != std::string::npos)
    fail("expected the name of a {}, or a file, came '{}'", function ? "curve" : "contour", name.substr(0, 40));
  const fs::path shipped = find_shipped(L, name, function ? ".func" : ".con");
  const fs::path path = shipped.empty() ? find_file(L, name, function) : shipped;
  const std::string text = read_file(path.string(), largest_file);
  const bool beside = !fs::path(name).is_absolute() && path == script_folder(L) / name;
  if (shipped.empty()) note_file(L, path.string(), name, beside, text);
  std::vector<DrawnCurve> curves = read_lstudio(text, path.string());
  if (curves[0].is_function != function)
    fail("{} holds {}, expected {}", path.string(), function ? "contours" : "functions",
         function ? "functions" : "contours");
  if (curves.size() > 1 && item.empty())
    fail("{} holds {} curves; name one of them: {}", path.string(), curves.size(), titles(curves));
  std::vector<std::string> names;
  for (DrawnCurve& curve : curves) {
    names.push_back(curve.name);
    if (item.empty() || curve.name == item) return std::move(curve);
  }
  fail("{} holds no curve '{}'{}; it has {}", path.string(), item.substr(0, 200), did_you_mean(item, names),
       titles(curves));
}

void write_curve_file(lua_State* L, const std::string& path, const std::string& text) {
  if (path.empty() || path.size() > 4096 || path.find('\0') != std::string::npos)
    fail("expected the path of a file, came '{}'", path.substr(0, 40));
  if (host(L).rules > 0) fail("a rule cannot write a file; rules only compute");
  write_atomic(path, text);
}

}  // namespace tunica::lua
