// SPDX-License-Identifier: MIT
#include "tissue/statistics.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "base/error.h"
#include "tissue/topology.h"

namespace tunica {

namespace {

double mean_of(const std::vector<double>& values) {
  double sum = 0;
  for (const double value : values) sum += value;
  return values.empty() ? 0 : sum / static_cast<double>(values.size());
}

double deviation_of(const std::vector<double>& values) {
  const double mean = mean_of(values);
  double squares = 0;
  for (const double value : values) squares += (value - mean) * (value - mean);
  return values.empty() ? 0 : std::sqrt(squares / static_cast<double>(values.size()));
}

/// The least interior angle of a cell, in degrees, over its corners where three or more walls meet.
double least_angle_of(const Tissue& tissue, Index cell) {
  std::vector<Vec3> corners;
  const Index first = tissue.first_side(cell);
  Index side = first;
  do {
    if (degree(tissue, tissue.start(side)) > 2) corners.push_back(tissue.position(tissue.start(side)));
    side = tissue.next(side);
  } while (side != first);
  if (corners.size() < 3) corners = tissue.polygon(cell);
  double least = 180;
  for (size_t i = 0; i < corners.size(); ++i) {
    const Vec3 a = corners[(i + 1) % corners.size()] - corners[i];
    const Vec3 b = corners[(i + corners.size() - 1) % corners.size()] - corners[i];
    const double cosine = std::clamp(a.dot(b) / (a.norm() * b.norm()), -1., 1.);
    least = std::min(least, std::acos(cosine) * 180 / std::numbers::pi);
  }
  return least;
}

void describe_sides(const std::vector<size_t>& sides, const std::vector<double>& areas, CellStatistics& result) {
  const double count = static_cast<double>(sides.size());
  const size_t most = *std::max_element(sides.begin(), sides.end());
  result.shares.assign(most + 1, 0);
  result.area_by_sides.assign(most + 1, 0);
  std::vector<double> n;
  for (size_t i = 0; i < sides.size(); ++i) {
    result.shares[sides[i]] += 1;
    result.area_by_sides[sides[i]] += areas[i] / result.mean_area;
    n.push_back(static_cast<double>(sides[i]));
  }
  for (size_t k = 0; k <= most; ++k) {
    if (result.shares[k] > 0) result.area_by_sides[k] /= result.shares[k];
    result.shares[k] /= count;
  }
  result.mean_sides = mean_of(n);
  result.variance_sides = deviation_of(n) * deviation_of(n);
  double covariance = 0;
  for (size_t i = 0; i < n.size(); ++i) covariance += (n[i] - result.mean_sides) * (areas[i] / result.mean_area - 1);
  if (result.variance_sides > 0) result.lewis_slope = covariance / count / result.variance_sides;
}

}  // namespace

CellStatistics cell_statistics(const Tissue& tissue) {
  if (!tissue.has_geometry()) fail("a tissue without geometry (line, ring, grid, cylinder) has no cell shapes");
  CellStatistics result;
  result.cells = tissue.cells();
  result.least_angle.assign(18, 0);
  for (Index j = 0; j < tissue.junctions(); ++j) result.four_way += degree(tissue, j) > 3 ? 1 : 0;
  std::vector<size_t> sides;
  std::vector<double> areas, angles;
  for (Index cell = 0; cell < tissue.cells(); ++cell) {
    if (tissue.on_border(cell)) continue;
    sides.push_back(tissue.neighbours(cell).size());
    areas.push_back(tissue.area(cell));
    angles.push_back(least_angle_of(tissue, cell));
  }
  result.interior = static_cast<Index>(sides.size());
  if (sides.empty()) return result;
  result.mean_area = mean_of(areas);
  result.area_cv = deviation_of(areas) / result.mean_area;
  describe_sides(sides, areas, result);
  for (const double angle : angles) {
    result.least_angle[std::min<size_t>(17, static_cast<size_t>(angle / 10))] += 1 / static_cast<double>(angles.size());
    result.sharp_cells += angle < 45 ? 1 / static_cast<double>(angles.size()) : 0;
  }
  result.mean_least_angle = mean_of(angles);
  return result;
}

// === Peaks

namespace {

const Column& cell_column(const Tissue& tissue, std::string_view name) {
  if (const Column* found = tissue.find_column(Kind::cell, name)) return *found;
  std::vector<std::string> names;
  for (const auto& column : tissue.columns(Kind::cell)) names.push_back(column->name);
  fail("the cell has no column '{}'{}", name, did_you_mean(name, names));
}

bool is_peak(const Tissue& tissue, const Column& column, Index cell) {
  for (const Index n : tissue.neighbours(cell))
    if (column.values[static_cast<size_t>(n)] >= column.values[static_cast<size_t>(cell)]) return false;
  return true;
}

}  // namespace

Peaks find_peaks(const Tissue& tissue, std::string_view name) {
  std::vector<double> numbers;
  for (const double value : cell_column(tissue, name).values)
    if (!std::isnan(value)) numbers.push_back(value);
  return find_peaks(tissue, name, mean_of(numbers));
}

Peaks find_peaks(const Tissue& tissue, std::string_view name, double above) {
  const Column& column = cell_column(tissue, name);
  Peaks peaks;
  for (Index cell = 0; cell < tissue.cells(); ++cell)
    if (column.values[static_cast<size_t>(cell)] > above && is_peak(tissue, column, cell)) peaks.cells.push_back(cell);
  if (!tissue.has_geometry() || peaks.cells.size() < 2) return peaks;
  std::vector<double> distances;
  for (const Index a : peaks.cells) {
    double least = std::numeric_limits<double>::infinity();
    for (const Index b : peaks.cells)
      if (a != b) least = std::min(least, (tissue.centroid(a) - tissue.centroid(b)).norm());
    distances.push_back(least);
  }
  peaks.mean_distance = mean_of(distances);
  peaks.distance_cv = deviation_of(distances) / peaks.mean_distance;
  return peaks;
}

Pair find_pair(const Tissue& tissue, std::string_view column, double above, const std::vector<Within>& bounds) {
  const double* value = cell_column(tissue, column).values.data();
  std::vector<const double*> bounded;
  for (const Within& each : bounds) bounded.push_back(cell_column(tissue, each.column).values.data());
  const auto fits = [&](Index c) {
    if (!(value[c] > above)) return false;
    for (size_t i = 0; i < bounds.size(); ++i)
      if (!(bounded[i][c] >= bounds[i].low && bounded[i][c] <= bounds[i].high)) return false;
    return true;
  };
  Pair best{none, none};
  const auto ids = [&](const Pair& p) {
    return std::minmax({tissue.id(Kind::cell, p.first), tissue.id(Kind::cell, p.second)});
  };
  for (Index cell = 0; cell < tissue.cells(); ++cell) {
    if (!fits(cell)) continue;
    for (const Index other : tissue.neighbours(cell)) {
      const bool ahead = value[cell] > value[other] ||
                         (value[cell] == value[other] && tissue.id(Kind::cell, cell) < tissue.id(Kind::cell, other));
      if (!ahead || !fits(other)) continue;
      const Pair pair{cell, other};
      if (best.first == none || value[other] > value[best.second] ||
          (value[other] == value[best.second] && ids(pair) < ids(best)))
        best = pair;
    }
  }
  return best;
}

double checkerboard_index(const Tissue& tissue, const double* values) {
  std::vector<double> sum(tissue.cells(), 0.0), u(tissue.cells(), 0.0);
  std::vector<int> count(tissue.cells(), 0);
  const auto each_pair = [&](auto&& visit) {
    for (Index wall = 0; wall < tissue.walls(); ++wall)
      if (const Index other = tissue.wall_side(wall, 1); other != none)
        visit(tissue.cell_of(tissue.wall_side(wall, 0)), tissue.cell_of(other));
  };
  each_pair([&](Index a, Index b) {
    sum[a] += values[b], sum[b] += values[a];
    ++count[a], ++count[b];
  });
  for (Index c = 0; c < tissue.cells(); ++c) u[c] = count[c] > 0 ? values[c] - sum[c] / count[c] : 0;
  double product = 0, squares = 0;
  each_pair([&](Index a, Index b) {
    product += u[a] * u[b];
    squares += u[a] * u[a] + u[b] * u[b];
  });
  return squares > 0 && std::isfinite(squares) ? -2 * product / squares : 0;
}

bool alternates(const Tissue& tissue, double index) {
  Index pairs = 0;
  for (Index wall = 0; wall < tissue.walls(); ++wall) pairs += tissue.wall_side(wall, 1) != none;
  const double neighbours = 2.0 * pairs / std::max<Index>(1, tissue.cells());
  return index > std::min(0.9, 2.7 / (neighbours + 1));  // noise gives 2 / (neighbours + 1), or less
}

}  // namespace tunica
