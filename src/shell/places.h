// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

namespace tunica::shell {

/// Folder that holds the Lua half of the library (tunica/init.lua): beside the installed program, else in the sources.
std::string library_folder();

/// Folder of the shipped models.
std::string models_folder();

struct ShippedModel {
  std::string name;   ///< "patterning/ring"
  std::string about;  ///< first line of its header
};

/// All shipped models by name.
std::vector<ShippedModel> shipped_models();

/// Path of a script given by path or by the name of a shipped model. Errors: neither (names the nearest).
std::string find_script(const std::string& given);

/// "sheet" of "some/where/sheet.lua": what run directories are named after.
std::string stem_of(const std::string& path);

}  // namespace tunica::shell
