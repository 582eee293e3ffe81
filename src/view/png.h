// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/cancel.h"
#include "view/picture.h"

namespace tunica {

/// Keyword and text pairs kept in a PNG file ("Software", "Source", "tunica:parameters", ...).
using PngTexts = std::vector<std::pair<std::string, std::string>>;

/// A picture as the bytes of a PNG file; the same picture and texts give the same bytes. Without transparency in the
/// picture the file has none. Errors: sizes that do not fit; keywords that are not 1-79 Latin characters; Cancelled.
std::string encode_png(const Picture& picture, const PngTexts& texts = {}, const CancelFlag* cancel = nullptr);

/// The picture in a PNG file, of any kind of PNG. Errors: not a PNG, damaged.
Picture decode_png(std::string_view bytes);

/// The texts in a PNG file's tEXt and iTXt chunks (uncompressed ones). Errors: not a PNG, damaged.
PngTexts png_texts(std::string_view bytes);

}  // namespace tunica
