// SPDX-License-Identifier: MIT
#include "base/bytes.h"

#define XXH_INLINE_ALL
#include <xxhash.h>

namespace tunica {

std::string hash(std::string_view bytes) { return fmt::format("{:016x}", XXH3_64bits(bytes.data(), bytes.size())); }

}  // namespace tunica
