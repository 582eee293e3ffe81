// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

namespace tunica::sweep {

using Point = std::vector<double>;

/// Looks for the point of [0,1]^n with the least value, generation by generation: the points of one can be evaluated at
/// the same time. CMA-ES (Hansen 2006) of pagmo. A function of its settings and the values it is told, so that a search
/// that was broken off is taken up by telling it the same values again.
class Search {
 public:
  struct Settings {
    Point start;
    double step = 0.2;      ///< standard deviation of the first generation in each direction
    size_t population = 0;  ///< points of a generation, at least 5; 0 = 4 + 3 ln n, made even
    uint64_t seed = 1;
  };
  explicit Search(const Settings& settings);
  ~Search();
  Search(const Search&) = delete;

  size_t population() const;
  /// The points of the next generation. Coordinates that leave [0,1] are reflected into it.
  std::vector<Point> ask();
  /// Their values, in the same order; a point without value gets `worst`.
  void tell(const std::vector<double>& values);

  static constexpr double worst = 1e300;

 private:
  struct Inside;
  std::unique_ptr<Inside> inside_;
};

}  // namespace tunica::sweep
