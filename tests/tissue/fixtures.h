// SPDX-License-Identifier: MIT
#pragma once

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "base/random.h"
#include "tissue/validity.h"

namespace tunica::testing {

inline void expect_valid(const Tissue& tissue) {
  for (const std::string& problem : find_problems(tissue)) ADD_FAILURE() << problem;
}

/// The message of the Error that `body` throws.
template <class Body>
std::string error_of(Body&& body) {
  try {
    body();
  } catch (const Error& error) {
    return error.what();
  }
  return "(no error)";
}

#define EXPECT_ERROR(statement, part)                                                      \
  EXPECT_NE(::tunica::testing::error_of([&] { statement; }).find(part), std::string::npos) \
      << ::tunica::testing::error_of([&] { statement; })

/// Numbers of a test, the same every time.
class Dice {
 public:
  explicit Dice(uint64_t seed) : seed_(seed) {}
  double real() { return uniform({.seed = seed_, .purpose = purpose("test"), .cell = draw_++}); }
  double between(double low, double high) { return low + (high - low) * real(); }
  Index below(Index n) { return std::min(n - 1, static_cast<Index>(real() * n)); }

 private:
  uint64_t seed_, draw_ = 0;
};

inline std::string content_of(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  std::stringstream content;
  content << file.rdbuf();
  return content.str();
}

inline std::filesystem::path repository() { return std::filesystem::path(__FILE__).parent_path() / ".." / ".."; }

/// The data set that is not part of the repository (TUNICA_DATA, or ../shared/data beside it); it may be absent.
inline std::filesystem::path outside_folder() {
  const char* given = std::getenv("TUNICA_DATA");
  return given ? std::filesystem::path(given) : repository() / ".." / "shared" / "data";
}

/// A file of it, or "".
inline std::string outside_data(const std::string& name) {
  const std::filesystem::path folder = outside_folder();
  return std::filesystem::exists(folder / name) ? content_of(folder / name) : "";
}

inline Column& declare(Tissue& tissue, Kind kind, const char* name, double initial, Inherit inherit) {
  Column column;
  column.name = name;
  column.initial = initial;
  column.inherit = inherit;
  return tissue.add_column(kind, std::move(column));
}

inline double total(const Column& column) {
  double sum = 0;
  for (const double value : column.values) sum += value;
  return sum;
}

}  // namespace tunica::testing
