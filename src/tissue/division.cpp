// SPDX-License-Identifier: MIT
#include "tissue/division.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <queue>

#include "base/error.h"
#include "base/random.h"
#include "tissue/order.h"
#include "tissue/polygon.h"
#include "tissue/topology.h"
#include "tissue/validity.h"

namespace tunica {

namespace {

/// The mother, as division sees her: sides, where they start, and the place of the wall's ends among them.
struct Mother {
  const Tissue& tissue;
  Index cell = none;
  std::vector<Index> sides;
  std::vector<Vec3> corners;

  void become(Index c) {
    cell = c;
    tissue.collect_polygon(c, corners);
    sides.clear();
    const Index first = tissue.first_side(c);
    Index side = first;
    do sides.push_back(side);
    while ((side = tissue.next(side)) != first);
  }
  size_t size() const { return sides.size(); }
  size_t after(size_t i) const { return i + 1 < size() ? i + 1 : 0; }
  size_t before(size_t i) const { return (i > 0 ? i : size()) - 1; }
  double length(size_t i) const { return tissue.length(tissue.wall_of(sides[i])); }
  Vec3 point(size_t i, double at) const { return corners[i] + at * (corners[after(i)] - corners[i]); }
  /// Whether more than two walls meet where a side starts: no single cell is across both walls of the mother there.
  bool walls_meet_at(size_t i) const {
    const Index ahead = tissue.opposite(sides[i]), behind = tissue.opposite(sides[before(i)]);
    if (ahead == none || behind == none) return ahead != behind;
    return tissue.next(ahead) != behind;
  }
};

struct End {
  size_t side;  ///< number in the mother's cycle
  double at;    ///< fraction of it
};

/// A place found by walking `distance` along the outline from the start of a side.
End walk(const Mother& mother, size_t from, double distance) {
  for (size_t steps = 0; steps < mother.size() && distance > mother.length(from); ++steps) {
    distance -= mother.length(from);
    from = mother.after(from);
  }
  return {from, std::clamp(distance / mother.length(from), 0., 1.)};
}

/// Keeps an end away from where walls meet. Along a traced wall that is measured over the points that trace it; then
/// the end keeps clear of the nearest of these points too, which may be corners.
End displace(const Mother& mother, End end, double gap) {
  size_t first = end.side;
  double behind = end.at * mother.length(end.side), whole = mother.length(end.side);
  size_t turns = 0;
  for (; !mother.walls_meet_at(first) && turns < mother.size(); ++turns) {
    first = mother.before(first);
    behind += mother.length(first);
    whole += mother.length(first);
  }
  if (turns < mother.size()) {
    for (size_t last = mother.after(end.side); !mother.walls_meet_at(last); last = mother.after(last))
      whole += mother.length(last);
    const double keep = std::min(gap, .45 * whole);
    if (behind < keep || behind > whole - keep) end = walk(mother, first, std::clamp(behind, keep, whole - keep));
  }
  // Even with no gap asked for, a new wall starts on a wall and not in a junction.
  const double keep = std::clamp(gap / mother.length(end.side), 1e-3, .45);
  end.at = std::clamp(end.at, keep, 1 - keep);
  return end;
}

/// What a division would make: where the wall's ends lie, and the polygons of the cells it touches.
struct Plan {
  End a, b;
  Vec3 at_a, at_b;
  std::vector<Vec3> piece_a, piece_b;    ///< of the mother: from end a counter-clockwise to end b, and from b to a
  std::vector<Vec3> across_a, across_b;  ///< the neighbours at the ends (if any), with the new junctions put in
};

/// A mother and the plan for her. Made once for many divisions, it keeps the room of its lists.
struct Work {
  Mother mother;
  Plan plan;
};

void set_piece(std::vector<Vec3>& points, const Mother& mother, const End& from, const Vec3& start, const End& to,
               const Vec3& stop) {
  points.assign(1, start);
  for (size_t i = from.side; i != to.side;) points.push_back(mother.corners[i = mother.after(i)]);
  points.push_back(stop);
}

bool on_border(const Mother& mother, const End& end) { return mother.tissue.opposite(mother.sides[end.side]) == none; }

void make_plan(Plan& plan, const Mother& mother, End a, End b, double gap, double pinch, const Surface* surface) {
  plan.a = displace(mother, a, gap);
  plan.b = displace(mother, b, gap);
  const auto onto = [&](const Vec3& p) { return surface ? surface->onto(p) : p; };
  const Vec3 p = onto(mother.point(plan.a.side, plan.a.at)), q = onto(mother.point(plan.b.side, plan.b.at));
  plan.at_a = on_border(mother, plan.a) ? p : onto(p + pinch * (q - p));
  plan.at_b = on_border(mother, plan.b) ? q : onto(q + pinch * (p - q));
  set_piece(plan.piece_a, mother, plan.a, plan.at_a, plan.b, plan.at_b);
  set_piece(plan.piece_b, mother, plan.b, plan.at_b, plan.a, plan.at_a);
}

void set_across(std::vector<Vec3>& points, const Mother& mother, const Plan& plan, Index neighbour) {
  const Tissue& tissue = mother.tissue;
  points.clear();
  const Index first = tissue.first_side(neighbour);
  Index side = first;
  do {
    points.push_back(tissue.position(tissue.start(side)));
    const Index opposite = tissue.opposite(side);
    if (opposite == mother.sides[plan.a.side]) points.push_back(plan.at_a);
    if (opposite == mother.sides[plan.b.side]) points.push_back(plan.at_b);
    side = tissue.next(side);
  } while (side != first);
}

/// Whether a polygon is a possible cell that faces outward.
/// @param near     outward somewhere on it
/// @param outside  the surface, if it knows its outside; or else outward is `near`
bool is_possible(const std::vector<Vec3>& polygon, const Vec3& near, const Surface* outside) {
  if (is_plain_cell(polygon, near)) return true;
  if (!is_possible_cell(polygon)) return false;
  const Vec3 outward = outside ? outside->normal(measure(polygon).centroid) : near;
  return Frame(polygon).normal.dot(outward) > 0;
}

bool is_possible(const Mother& mother, Plan& plan, const Surface* surface) {
  if (plan.a.side == plan.b.side) return false;
  const Tissue& tissue = mother.tissue;
  const Surface* outside = surface && surface->has_outside() ? surface : nullptr;
  // Outward is where the surface faces, or else where the cell did before.
  const auto outward = [&](Index cell, const Vec3& place) {
    return outside ? outside->facing(place) : tissue.normal(cell);
  };
  const auto possible_across = [&](const End& end, const Vec3& place, std::vector<Vec3>& across) {
    const Index neighbour = tissue.neighbour(mother.sides[end.side]);
    if (neighbour == none) return true;
    set_across(across, mother, plan, neighbour);
    return is_possible(across, outward(neighbour, place), outside);
  };
  const Vec3 near = outward(mother.cell, plan.at_a);
  return is_possible(plan.piece_a, near, outside) && is_possible(plan.piece_b, near, outside) &&
         possible_across(plan.a, plan.at_a, plan.across_a) && possible_across(plan.b, plan.at_b, plan.across_b);
}

End end_of(const Mother& mother, Index side, double at) {
  const auto found = std::find(mother.sides.begin(), mother.sides.end(), side);
  if (found == mother.sides.end() || !(at >= 0 && at <= 1))
    fail("the dividing wall does not end on a wall of cell {}", mother.tissue.id(Kind::cell, mother.cell));
  return {static_cast<size_t>(found - mother.sides.begin()), at};
}

void find_plan(Work& work, const Cut& cut, const DivisionSettings& settings, const Surface* surface) {
  const Mother& mother = work.mother;
  const End a = end_of(mother, cut.side_a, cut.at_a), b = end_of(mother, cut.side_b, cut.at_b);
  const double relative = settings.gap_fraction * std::sqrt(mother.tissue.area(mother.cell));
  const double gap = settings.gap >= 0 ? settings.gap : relative;
  const std::pair<double, double> tries[] = {{gap, settings.pinch}, {gap, 0}, {gap / 4, 0}, {0, 0}};
  for (const auto& [try_gap, try_pinch] : tries) {
    make_plan(work.plan, mother, a, b, try_gap, try_pinch, surface);
    if (is_possible(mother, work.plan, surface)) return;
  }
  throw Indivisible(
      fmt::format("cell {} cannot be divided there: a daughter or a neighbour would have no area or cross itself",
                  mother.tissue.id(Kind::cell, mother.cell)));
}

/// What the parts of a wall and of its sides get when a junction at `p` splits it.
std::array<Parts, 3> legacy_of_wall(Tissue& tissue, Index wall, const Vec3& p) {
  const Index side0 = tissue.wall_side(wall, 0), side1 = tissue.wall_side(wall, 1);
  const double first = (p - tissue.position(tissue.start(side0))).norm();
  const double second = (p - tissue.position(tissue.end(side0))).norm();
  const double share = first / (first + second);
  std::array<Parts, 3> legacy{
      parts_of(tissue, Kind::wall, wall, share), parts_of(tissue, Kind::side, side0, share), {}};
  if (side1 != none) legacy[2] = parts_of(tissue, Kind::side, side1, 1 - share);
  return legacy;
}

/// Measures the daughters. Their polygons are then those of their cycles: of two, the first daughter is the one that
/// has the mother's first_side, and starts there; the second starts at a new junction.
std::pair<Measure, Measure> measure_daughters(const Mother& mother, Plan& plan) {
  // Side a itself ends up half in each daughter; its first half, with its number, is in piece b-a.
  const bool first_is_a = plan.a.side > plan.b.side;
  auto &first = first_is_a ? plan.piece_a : plan.piece_b, &second = first_is_a ? plan.piece_b : plan.piece_a;
  const size_t start = mother.size() - (first_is_a ? plan.a : plan.b).side;
  std::rotate(first.begin(), first.begin() + static_cast<std::ptrdiff_t>(start), first.end());
  return {measure(first), measure(second)};
}

void check(const DivisionSettings& settings) {
  if (!std::isfinite(settings.gap) || !(settings.gap_fraction >= 0 && settings.gap_fraction <= 1))
    fail("the gap of a dividing wall must be a length and its fraction between 0 and 1, not {} and {}", settings.gap,
         settings.gap_fraction);
  if (!(settings.pinch >= 0 && settings.pinch < .5))
    fail("pinch must be at least 0 and below 0.5, not {}", settings.pinch);
}

/// A division, and the cells across the ends of its wall (or none).
struct Outcome {
  Division division;
  Index across_a, across_b;
  std::array<Index, 4> touched() const { return {division.first, division.second, across_a, across_b}; }
};

Outcome perform(Tissue& tissue, Work& work) {
  auto& [mother, plan] = work;
  // All that can fail comes first: then the structure changes.
  const Index side_a = mother.sides[plan.a.side], side_b = mother.sides[plan.b.side];
  const Index wall_a = tissue.wall_of(side_a), wall_b = tissue.wall_of(side_b);
  const Index across_a = tissue.neighbour(side_a), across_b = tissue.neighbour(side_b);
  const auto [first, second] = measure_daughters(mother, plan);
  const auto of_a = legacy_of_wall(tissue, wall_a, plan.at_a), of_b = legacy_of_wall(tissue, wall_b, plan.at_b);
  const Parts of_cell = parts_of(tissue, Kind::cell, mother.cell, first.area / (first.area + second.area));
  TissueEditor editor(tissue);
  editor.require_room(Kind::side, 10);
  editor.split_wall(wall_a, plan.at_a, of_a);
  editor.split_wall(wall_b, plan.at_b, of_b);
  const Index wall = editor.split_cell(tissue.next(side_a), tissue.next(side_b), of_cell);
  const Division division{mother.cell, tissue.cell_of(tissue.wall_side(wall, 1)), wall};
  editor.set_measure(division.first, first);
  editor.set_measure(division.second, second);
  if (across_a != none) editor.set_measure(across_a, measure(plan.across_a));
  if (across_b != none) editor.set_measure(across_b, measure(plan.across_b));
  const Outcome outcome{division, across_a, across_b};
#ifdef TUNICA_VALIDATE
  std::vector<Index> touched;
  for (const Index cell : outcome.touched())
    if (cell != none) touched.push_back(cell);
  validate_near(tissue, touched);
#endif
  return outcome;
}

Outcome divide_one(Work& work, Tissue& tissue, Index cell, const DivisionRule& rule, const DivisionSettings& settings,
                   const Surface* surface) {
  work.mother.become(cell);
  {
    const LockWhile rule_and_surface_may_be_scripts(tissue);
    find_plan(work, rule(tissue, cell), settings, surface);
  }
  return perform(tissue, work);
}

void check_divisible(const Tissue& tissue, const DivisionSettings& settings) {
  if (tissue.locked()) fail("the structure of a tissue cannot change while rules run");
  if (!tissue.has_geometry()) fail("cells without geometry (line, ring, grid, cylinder) cannot be divided by a wall");
  check(settings);
}

}  // namespace

Division divide(Tissue& tissue, Index cell, const Cut& cut, const DivisionSettings& settings, const Surface* surface) {
  return divide(
      tissue, cell, [&](const Tissue&, Index) { return cut; }, settings, surface);
}

Division divide(Tissue& tissue, Index cell, const DivisionRule& rule, const DivisionSettings& settings,
                const Surface* surface) {
  check_divisible(tissue, settings);
  Work work{{tissue}, {}};
  return divide_one(work, tissue, cell, rule, settings, surface).division;
}

void Undivided::report(int64_t divisions) const {
  if (messages_.empty()) return;
  const size_t others = messages_.size() - 1;
  fail("{}{} ({})", messages_.begin()->second,
       others == 0   ? ""
       : others == 1 ? "; nor can another cell"
                     : fmt::format("; nor can {} other cells", others),
       divisions == 0   ? "nothing was divided"
       : divisions == 1 ? "elsewhere a cell was divided"
                        : fmt::format("elsewhere there were {} divisions", divisions));
}

double threshold_of(const Tissue& tissue, Index cell, const Threshold& threshold) {
  const double u =
      2 * uniform({.seed = tissue.seed(), .purpose = purpose("division"), .cell = tissue.id(Kind::cell, cell)}) - 1;
  return threshold.area * (1 + threshold.variation * u);
}

namespace {

/// Whether a growing tissue has passed one of the sizes 1000, 1250, 1562, ...: often enough to keep it in order, and a
/// matter of its size alone, so that a stopped and resumed run does the same.
bool passed_a_mark(Index before, Index now) {
  Index mark = 1000;
  while (mark <= before) mark += mark / 4;
  return mark <= now;
}

}  // namespace

int64_t divide_above(Tissue& tissue, const Threshold& threshold, const DivisionRule& rule,
                     const DivisionSettings& settings, const Surface* surface, const CancelFlag* cancel,
                     std::vector<Id>* changed) {
  check_divisible(tissue, settings);
  if (!(threshold.area > 0) || !std::isfinite(threshold.area))
    fail("the area at which cells divide must be positive, not {}", threshold.area);
  if (!(threshold.variation >= 0 && threshold.variation < 1))
    fail("the variation of the threshold must be at least 0 and below 1, not {}", threshold.variation);
  const double least = threshold.area * (1 - threshold.variation);
  std::priority_queue<Id, std::vector<Id>, std::greater<>> due;
  const auto consider = [&](Index cell) {
    if (cell != none && tissue.area(cell) > least && tissue.area(cell) > threshold_of(tissue, cell, threshold))
      due.push(tissue.id(Kind::cell, cell));
  };
  for (Index cell = 0; cell < tissue.cells(); ++cell) consider(cell);
  const Index before = tissue.cells();
  int64_t divisions = 0;
  Undivided undivided;
  Work work{{tissue}, {}};
  while (!due.empty() && (threshold.most_cells < 0 || tissue.cells() < threshold.most_cells)) {
    poll(cancel);
    const Index cell = tissue.find(Kind::cell, due.top());
    due.pop();
    // A neighbour's pinching may have changed the cell since; and it may be in the queue twice.
    if (cell == none || !(tissue.area(cell) > threshold_of(tissue, cell, threshold))) continue;
    const Id mother = tissue.id(Kind::cell, cell);
    try {
      const Outcome outcome = divide_one(work, tissue, cell, rule, settings, surface);
      ++divisions;
      undivided.remove(mother);
      for (const Index touched : outcome.touched()) {
        consider(touched);
        if (changed && touched != none) changed->push_back(tissue.id(Kind::cell, touched));
      }
    } catch (const Indivisible& error) {
      undivided.add(mother, error);
    }
  }
  // Daughters are appended, so neighbours drift apart in memory, and everything that walks the tissue would slow down.
  if (passed_a_mark(before, tissue.cells())) renumber_along_curve(tissue);
  undivided.report(divisions);
  return divisions;
}

}  // namespace tunica
