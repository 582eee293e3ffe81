// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace tunica::sweep {

/// A parameter as the model declares it.
struct Parameter {
  enum class Type { number, boolean, text };
  std::string name;
  Type type = Type::number;
  std::string value;  ///< the model's own, as text
  std::optional<double> min, max;
};

/// What a sweep does with one parameter: NAME=3 (fixed), 3,4,5 (list), 3..5 (range); behind a range, separated by
/// colons, a number of steps (for grids), `log` (equal ratios), `whole` (whole numbers).
struct Range {
  enum class Kind { fixed, list, interval };
  std::string name;
  Kind kind = Kind::fixed;
  std::vector<std::string> values;  ///< of a list; one if fixed
  double low = 0, high = 0;         ///< of a range
  int steps = 0;                    ///< of a range: values for a grid; 0 = not given
  bool log = false, whole = false;

  bool varies() const { return kind != Kind::fixed; }
  /// The value at a place from 0 (low) to 1 (high), as text that reads back as the same number.
  std::string at(double place) const;
  /// Where a value lies from 0 to 1, the inverse of `at`; outside the range, the nearer end.
  double place_of(double value) const;
  /// The values of a grid. Errors: a range without steps.
  std::vector<std::string> grid() const;
  /// As it would be written: "3..5:9".
  std::string text() const;
};

/// Reads what stands behind NAME=. Errors: reversed or empty ranges, values outside the parameter's own limits, values
/// that are not of its type.
Range read_range(const Parameter& parameter, const std::string& text);

/// Reads NAME=... arguments against the model's parameters; in their order. Errors: as read_range; unknown names, names
/// given twice.
std::vector<Range> read_ranges(const std::vector<Parameter>& parameters, const std::vector<std::string>& arguments);

/// A number as the shortest text that reads back as the same.
std::string shortest(double value);

}  // namespace tunica::sweep
