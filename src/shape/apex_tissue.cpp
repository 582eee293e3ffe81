// SPDX-License-Identifier: MIT
#include "shape/apex_tissue.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <tuple>

#include "base/error.h"
#include "shape/bulges.h"
#include "tissue/builders.h"
#include "tissue/division.h"
#include "tissue/order.h"
#include "tissue/topology.h"

namespace tunica {

namespace {

constexpr Index most_cells = 1'000'000;

void check(const Apex& apex, const ApexTissueSettings& s) {
  if ((s.to != 0) == (s.cells != 0)) fail("cells on an apex need one of: the arc length they reach, their number");
  if (!(s.to >= 0) || !std::isfinite(s.to)) fail("the arc length that cells reach must be positive, not {}", s.to);
  if (s.cells < 0 || s.cells > most_cells)
    fail("the number of cells on an apex must be between 1 and {}, not {}", most_cells, s.cells);
  if (!(s.max_area > 0) || !std::isfinite(s.max_area))
    fail("the area at which cells divide must be positive, not {}", s.max_area);
  if (!(s.growth > 0 && s.growth <= 1))
    fail("the growth between divisions must be above 0 and at most 1, not {}", s.growth);
  if (apex.profile().has_hole())
    fail("the apex has a hole of radius {:.4g} at its tip, so cells cannot grow from there", apex.profile().hole());
  // Two hundred places tell whether cells get there; a zero of the speed between two of them ends in the limit of
  // steps.
  for (int i = 1; i <= 200 && s.to > 0; ++i)
    if (const double a = i * s.to / 200; !(apex.speed(a) > 0))
      fail("the apex does not grow as far as {:.4g}: at arc length {:.4g} nothing moves away from the tip", s.to, a);
}

/// The arc length within which the apex has a given area.
double arc_of_area(const Apex& apex, double area) {
  double low = 0, high = std::sqrt(area);
  while (apex.area(high) < area) high *= 2;
  for (int i = 0; i < 60; ++i) {
    const double middle = (low + high) / 2;
    (apex.area(middle) < area ? low : high) = middle;
  }
  return high;
}

Tissue one_cell(const Apex& apex, double area, uint64_t seed) {
  const double a = arc_of_area(apex, area);
  std::vector<Vec3> corners;
  std::vector<Index> around;
  for (int i = 0; i < 8; ++i) {
    // The angle runs clockwise seen from above the tip, corners run the other way.
    corners.push_back(apex.position(-std::numbers::pi * i / 4, a));
    around.push_back(i);
  }
  return assemble(corners, {around}, seed);
}

/// The nearest and the farthest place of the border, as arc lengths.
std::pair<double, double> front(const Tissue& tissue, const Apex& apex) {
  std::vector<double> x, y, z;
  for (Index s = 0; s < tissue.sides(); ++s) {
    if (tissue.opposite(s) != none) continue;
    const Vec3& p = tissue.position(tissue.start(s));
    x.push_back(p.x()), y.push_back(p.y()), z.push_back(p.z());
  }
  std::vector<double> theta(x.size()), a(x.size());
  apex.places_of(x.data(), y.data(), z.data(), x.size(), theta.data(), a.data());
  const auto [nearest, farthest] = std::minmax_element(a.begin(), a.end());
  return {*nearest, *farthest};
}

double fastest(const Apex& apex, double to) {
  double rate = 0;
  for (int i = 0; i <= 64; ++i) rate = std::max(rate, apex.growth()(i * to / 64));
  return rate;
}

}  // namespace

Tissue apex_tissue(const Apex& apex, const ApexTissueSettings& s) {
  check(apex, s);
  Tissue tissue = one_cell(apex, s.max_area / 2, s.seed);
  const auto reached = [&](double border) { return s.to > 0 ? border >= s.to : tissue.cells() >= s.cells; };
  auto [nearest, farthest] = front(tissue, apex);
  for (int steps = 0; !reached(nearest); ++steps) {
    poll(s.cancel);
    const double rate = fastest(apex, farthest);
    if (!(rate > 0) || steps > 1'000'000)
      fail("the cells on the apex stop growing at arc length {:.4g}, before they are as many or as far as asked",
           farthest);
    grow(tissue, apex, 0, s.growth / (2 * rate));
    divide_above(tissue, {s.max_area, s.variation, s.cells > 0 ? s.cells : most_cells}, errera, {}, &apex, s.cancel);
    if (tissue.cells() >= most_cells)
      fail("cells of area {:.4g} on this apex are more than {}", s.max_area, most_cells);
    std::tie(nearest, farthest) = front(tissue, apex);
  }
  if (s.to > 0) remove_beyond(tissue, apex, s.to);
  renumber_along_curve(tissue);
  return tissue;
}

const Apex* apex_below(const Surface& surface) {
  if (const auto* apex = dynamic_cast<const Apex*>(&surface)) return apex;
  const auto* bulges = dynamic_cast<const Bulges*>(&surface);
  return bulges ? apex_below(bulges->base()) : nullptr;
}

namespace {

Column& place_column(Tissue& tissue, const char* name) {
  if (Column* column = tissue.find_column(Kind::cell, name)) return *column;
  Column column;
  column.name = name;
  return tissue.add_column(Kind::cell, std::move(column));
}

/// One of x, y, z of the centroids of all cells.
const double* centroids(const Tissue& tissue, const char* axis) {
  return tissue.find_column(Kind::cell, axis)->values.data();
}

/// Sets two columns of cells by their centroids. @param ask  (x, y, z, count, first, second), of so many points
template <class Ask>
void set_by_place(Tissue& tissue, Column& first, Column& second, const Ask& ask) {
  ask(centroids(tissue, "x"), centroids(tissue, "y"), centroids(tissue, "z"), static_cast<size_t>(tissue.cells()),
      first.values.data(), second.values.data());
}

template <class Ask>
void set_by_place(Tissue& tissue, Column& first, Column& second, const std::vector<Index>& cells, const Ask& ask) {
  const size_t n = cells.size();
  std::vector<double> values(5 * n);
  double *x = values.data(), *y = x + n, *z = y + n, *one = z + n, *two = one + n;
  for (size_t i = 0; i < n; ++i) {
    const Vec3 p = tissue.centroid(cells[i]);
    x[i] = p.x(), y[i] = p.y(), z[i] = p.z();
  }
  ask(x, y, z, n, one, two);
  for (size_t i = 0; i < n; ++i) {
    first.values[static_cast<size_t>(cells[i])] = one[i];
    second.values[static_cast<size_t>(cells[i])] = two[i];
  }
}

auto places_on(const Apex& apex) {
  return [&apex](auto... arguments) { apex.places_of(arguments...); };
}

}  // namespace

void locate(Tissue& tissue, const Apex& apex) {
  if (!tissue.has_geometry()) fail("cells without geometry have no place on an apex");
  Column& theta = place_column(tissue, "theta");
  set_by_place(tissue, theta, place_column(tissue, "a"), places_on(apex));
}

namespace {

/// What of a tissue follows a surface.
struct Followers {
  Tissue& tissue;
  const Apex* apex;
  const Bulges* bulges;
  Column *theta, *a, *primordium, *closeness;

  Followers(Tissue& t, const Surface& surface)
      : tissue(t), apex(apex_below(surface)), bulges(dynamic_cast<const Bulges*>(&surface)) {
    const auto column = [&](const char* name) { return tissue.find_column(Kind::cell, name); };
    theta = column("theta"), a = column("a"), primordium = column("primordium"), closeness = column("closeness");
    if (!theta || !a) apex = nullptr;
    if (!primordium || !closeness) bulges = nullptr;
  }
  /// @param cells  those that have moved; without, all
  void update(const auto&... cells) const {
    if (apex) set_by_place(tissue, *theta, *a, cells..., places_on(*apex));
    const auto depths = [&](auto... arguments) { bulges->deepest(arguments...); };
    if (bulges) set_by_place(tissue, *primordium, *closeness, cells..., depths);
  }
};

}  // namespace

void follow(Tissue& tissue, const Surface& surface) { Followers(tissue, surface).update(); }

void follow(Tissue& tissue, const Surface& surface, const std::vector<Id>& only) {
  std::vector<Index> cells;
  for (const Id id : only)
    if (const Index c = tissue.find(Kind::cell, id); c != none) cells.push_back(c);
  std::sort(cells.begin(), cells.end());
  cells.erase(std::unique(cells.begin(), cells.end()), cells.end());
  Followers(tissue, surface).update(cells);
}

int64_t remove_beyond(Tissue& tissue, const Apex& apex, double a) {
  if (!std::isfinite(a)) fail("the arc length beyond which cells go must be finite, not {}", a);
  if (!tissue.has_geometry()) fail("cells without geometry have no place on an apex");
  std::vector<Id> gone;
  const std::vector<char> beyond = apex.are_beyond(centroids(tissue, "x"), centroids(tissue, "y"),
                                                   centroids(tissue, "z"), static_cast<size_t>(tissue.cells()), a);
  for (Index c = 0; c < tissue.cells(); ++c)
    if (beyond[static_cast<size_t>(c)]) gone.push_back(tissue.id(Kind::cell, c));
  const auto count = static_cast<int64_t>(gone.size());
  remove_cells(tissue, std::move(gone));
  return count;
}

}  // namespace tunica
