// SPDX-License-Identifier: MIT
#pragma once

#include <map>
#include <string>
#include <string_view>

namespace tunica {

/// Named byte strings as one file image: magic, format version, length, checksum (XXH3), sections in order of name.
/// What checkpoints are made of.
std::string pack_sections(const std::map<std::string, std::string_view>& sections);

/// The sections of what pack_sections wrote. Errors: another kind of file, a newer format, cut, or damaged anywhere.
std::map<std::string, std::string> unpack_sections(std::string_view bytes);

}  // namespace tunica
