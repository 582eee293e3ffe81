// SPDX-License-Identifier: MIT
#include "shell/places.h"

#include <algorithm>
#include <filesystem>
#include <fstream>

#include "base/error.h"

namespace tunica::shell {

namespace {

namespace fs = std::filesystem;

/// `installed` under share/tunica beside the program, else `in_sources`, where this program was built.
std::string shared_folder(const char* installed, const char* in_sources) {
  std::error_code error;
  const fs::path program = fs::read_symlink("/proc/self/exe", error);
  const fs::path beside = program.parent_path().parent_path() / "share/tunica" / installed;
  if (!error && fs::is_directory(beside, error)) return beside.string();
  return (fs::path(TUNICA_SOURCE_DIR) / in_sources).string();
}

/// The first comment line of a script without its dashes.
std::string first_comment(const fs::path& path) {
  std::ifstream file(path);
  for (std::string line; std::getline(file, line);) {
    const size_t start = line.find_first_not_of("- \t");
    if (line.starts_with("--") && start != std::string::npos && line.find("SPDX") == std::string::npos)
      return line.substr(start);
    if (!line.starts_with("--") && !line.starts_with("#") && !line.empty()) break;
  }
  return "";
}

}  // namespace

std::string library_folder() { return shared_folder("lua", "lua"); }
std::string models_folder() { return shared_folder("scripts", "scripts"); }

std::vector<ShippedModel> shipped_models() {
  std::vector<ShippedModel> models;
  const fs::path folder = models_folder();
  std::error_code error;
  for (fs::recursive_directory_iterator i(folder, error), end; !error && i != end; i.increment(error)) {
    if (!i->is_regular_file() || i->path().extension() != ".lua") continue;
    if (i->path().parent_path().filename() == "parts") continue;  // of models, which require them
    fs::path name = fs::relative(i->path(), folder);
    models.push_back({name.replace_extension().string(), first_comment(i->path())});
  }
  std::sort(models.begin(), models.end(), [](const auto& a, const auto& b) { return a.name < b.name; });
  return models;
}

std::string find_script(const std::string& given) {
  std::error_code error;
  if (fs::is_directory(given, error)) fail("'{}' is a folder; expected a Lua script or the name of a model", given);
  if (fs::exists(given, error)) return given;
  const fs::path shipped = fs::path(models_folder()) / (given.ends_with(".lua") ? given : given + ".lua");
  if (fs::is_regular_file(shipped, error)) return shipped.string();
  std::vector<std::string> names;
  for (const auto& model : shipped_models()) {
    names.push_back(model.name);
    names.push_back(model.name.substr(model.name.rfind('/') + 1));
  }
  std::string near = nearest(given, names);
  for (const auto& model : shipped_models())
    if (model.name.ends_with("/" + near)) near = model.name;
  fail("no file and no shipped model is called '{}'{}; `tunica models` lists them", given,
       near.empty() ? "" : "; did you mean '" + near + "'?");
}

std::string stem_of(const std::string& path) {
  const std::string stem = fs::path(path).stem().string();
  return stem.empty() ? "model" : stem;
}

}  // namespace tunica::shell
