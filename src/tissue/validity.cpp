// SPDX-License-Identifier: MIT
#include "tissue/validity.h"

#include <algorithm>
#include <cmath>
#include <functional>

#include "base/error.h"
#include "tissue/polygon.h"
#include "tissue/topology.h"

namespace tunica {

namespace {

/// The check proper. Each function reports through say(); those that walk the structure need in_range() to hold first.
class Check {
 public:
  Check(const Tissue& tissue, size_t most) : t_(tissue), most_(most) {}

  bool in_range(Kind kind, Index i) {
    switch (kind) {
      case Kind::cell:
        return expect(i, kind, within(t_.first_side(i), Kind::side) || (!t_.has_geometry() && t_.first_side(i) == none),
                      "has a first side that does not exist");
      case Kind::wall: {
        const Index second = t_.wall_side(i, 1);
        return expect(i, kind, within(t_.wall_side(i, 0), Kind::side) && (second == none || within(second, Kind::side)),
                      "has a side that does not exist");
      }
      case Kind::side:
        return expect(i, kind, within(t_.next(i), Kind::side) && within(t_.previous(i), Kind::side),
                      "has a next or previous side that does not exist") &&
               expect(i, kind, within(t_.cell_of(i), Kind::cell), "has a cell that does not exist") &&
               expect(i, kind, within(t_.wall_of(i), Kind::wall), "has a wall that does not exist") &&
               expect(i, kind, t_.has_geometry() ? within(t_.start(i), Kind::junction) : t_.start(i) == none,
                      "starts at a junction that does not exist");
      case Kind::junction:
        return expect(i, kind, within(t_.junction_side(i), Kind::side), "has a side that does not exist");
    }
    return false;
  }

  void side(Index s) {
    expect(s, Kind::side, t_.previous(t_.next(s)) == s && t_.next(t_.previous(s)) == s,
           "is not the previous of its next and the next of its previous");
    expect(s, Kind::side, t_.cell_of(t_.next(s)) == t_.cell_of(s), "has a next side in another cell");
    const Index wall = t_.wall_of(s);
    expect(s, Kind::side, (t_.wall_side(wall, 0) == s) != (t_.wall_side(wall, 1) == s),
           "is not one of its wall's two sides");
  }

  void wall(Index w) {
    const Index a = t_.wall_side(w, 0), b = t_.wall_side(w, 1);
    expect(w, Kind::wall, t_.wall_of(a) == w && (b == none || t_.wall_of(b) == w), "has a side of another wall");
    if (b == none) {
      expect(w, Kind::wall, t_.has_geometry(), "has one side only, in a tissue without geometry");
      return;
    }
    expect(w, Kind::wall, t_.cell_of(a) != t_.cell_of(b), "has the same cell on both sides");
    if (t_.has_geometry())
      expect(w, Kind::wall, t_.start(a) == t_.end(b) && t_.start(b) == t_.end(a),
             "has sides that do not run opposite ways");
  }

  /// The cycle of a cell: closed, its own, long enough. @return its length
  Index cycle(Index c) {
    const Index first = t_.first_side(c);
    if (first == none) return 0;
    Index length = 0, s = first;
    do {
      if (!expect(c, Kind::cell, t_.cell_of(s) == c, "has a side of another cell in its cycle")) return length;
      if (!expect(c, Kind::cell, ++length <= t_.sides(), "has sides that do not close to a cycle")) return length;
      s = t_.next(s);
    } while (s != first);
    if (t_.has_geometry()) expect(c, Kind::cell, length >= 3, "has fewer than three sides");
    return length;
  }

  void shape(Index c) {
    const std::vector<Vec3> polygon = t_.polygon(c);
    for (const Vec3& p : polygon)
      if (!expect(c, Kind::cell, p.allFinite(), "has a junction at no finite place")) return;
    if (!expect(c, Kind::cell, t_.area(c) > 0 && std::isfinite(t_.area(c)), "has no positive area")) return;
    expect(c, Kind::cell, is_simple(Frame(polygon).flat(polygon)), "has a polygon that crosses itself");
    std::vector<Index> corners;
    const Index first = t_.first_side(c);
    Index s = first;
    do corners.push_back(t_.start(s));
    while ((s = t_.next(s)) != first);
    std::sort(corners.begin(), corners.end());
    expect(c, Kind::cell, std::adjacent_find(corners.begin(), corners.end()) == corners.end(),
           "comes to the same junction twice");
  }

  /// @return how many sides the junction's fan has
  Index junction(Index j) {
    const std::vector<Index> around = sides_at(t_, j);
    for (const Index s : around)
      if (!expect(j, Kind::junction, t_.start(s) == j, "has a side in its fan that starts elsewhere")) break;
    expect(j, Kind::junction, degree(t_, j) >= 2, "is met by fewer than two walls");
    return static_cast<Index>(around.size());
  }

  bool expect(Index index, Kind kind, bool holds, const char* problem) {
    if (!holds) say(fmt::format("{} {} {}", name_of(kind), t_.id(kind, index), problem));
    return holds;
  }
  void say(std::string problem) {
    if (problems.size() < most_) problems.push_back(std::move(problem));
  }
  bool full() const { return problems.size() >= most_; }

  std::vector<std::string> problems;

 private:
  bool within(Index i, Kind kind) const { return i >= 0 && i < t_.count(kind); }
  const Tissue& t_;
  size_t most_;
};

constexpr Kind all_kinds[] = {Kind::cell, Kind::wall, Kind::side, Kind::junction};

void check_names_and_columns(const Tissue& t, Check& check) {
  for (const Kind kind : all_kinds) {
    for (Index i = 0; i < t.count(kind) && !check.full(); ++i)
      check.expect(i, kind, t.id(kind, i) != 0 && t.find(kind, t.id(kind, i)) == i, "is not found by its identity");
    size_t alive = 0;
    for (Id id = 1; id <= t.last_id(kind) && t.last_id(kind) != 0; ++id) alive += t.find(kind, id) != none ? 1 : 0;
    if (alive != static_cast<size_t>(t.count(kind)))
      check.say(fmt::format("{} {}s are there, but {} identities name one", t.count(kind), name_of(kind), alive));
    for (const auto& column : t.columns(kind))
      if (column->values.size() != static_cast<size_t>(t.count(kind)))
        check.say(fmt::format("column '{}' has {} values for {} {}s", column->name, column->values.size(),
                              t.count(kind), name_of(kind)));
  }
}

void check_structure(const Tissue& t, Check& check) {
  for (Index s = 0; s < t.sides() && !check.full(); ++s) check.side(s);
  for (Index w = 0; w < t.walls() && !check.full(); ++w) check.wall(w);
  long in_cycles = 0, at_junctions = 0;
  for (Index c = 0; c < t.cells() && !check.full(); ++c) in_cycles += check.cycle(c);
  if (!check.problems.empty()) return;
  if (in_cycles != t.sides()) check.say(fmt::format("{} sides are in no cell's cycle", t.sides() - in_cycles));
  if (!t.has_geometry()) return;
  for (Index j = 0; j < t.junctions() && !check.full(); ++j) at_junctions += check.junction(j);
  if (check.problems.empty() && at_junctions != t.sides())
    check.say("cells hang together at a junction only: its sides make more than one fan");
}

void check_euler(const Tissue& t, Check& check) {
  for (const Component& part : components(t)) {
    const long twice_handles = 2 - part.borders - part.euler();
    if (twice_handles < 0 || twice_handles % 2 != 0)
      check.say(fmt::format("a part of {} cells has V - E + F = {} with {} border lines: not a surface", part.cells,
                            part.euler(), part.borders));
  }
}

}  // namespace

std::vector<std::string> find_structural_problems(const Tissue& tissue, size_t most) {
  Check check(tissue, most);
  for (const Kind kind : all_kinds)
    for (Index i = 0; i < tissue.count(kind) && !check.full(); ++i) check.in_range(kind, i);
  if (check.problems.empty()) check_names_and_columns(tissue, check);
  if (check.problems.empty()) check_structure(tissue, check);
  if (check.problems.empty() && tissue.has_geometry()) check_euler(tissue, check);
  return check.problems;
}

std::vector<std::string> find_problems(const Tissue& tissue, size_t most) {
  std::vector<std::string> structural = find_structural_problems(tissue, most);
  if (!structural.empty() || !tissue.has_geometry()) return structural;
  Check check(tissue, most);
  for (Index c = 0; c < tissue.cells() && !check.full(); ++c) check.shape(c);
  return check.problems;
}

void validate(const Tissue& tissue) {
  const std::vector<std::string> problems = find_problems(tissue, 1);
  if (!problems.empty()) fail("the tissue is not valid: {}", problems[0]);
}

void validate_near(const Tissue& tissue, const std::vector<Index>& cells) {
  Check check(tissue, 1);
  for (const Index c : cells) {
    check.cycle(c);
    const Index first = tissue.first_side(c);
    if (first == none) continue;
    Index s = first;
    do {
      check.side(s);
      check.wall(tissue.wall_of(s));
      if (tissue.has_geometry()) check.junction(tissue.start(s));
    } while ((s = tissue.next(s)) != first);
    if (tissue.has_geometry()) check.shape(c);
  }
  if (!check.problems.empty()) fail("the tissue is not valid: {}", check.problems[0]);
}

std::vector<Component> components(const Tissue& tissue) {
  std::vector<int> part(static_cast<size_t>(tissue.cells()), -1);
  std::vector<Component> result;
  std::vector<Index> stack;
  for (Index seed = 0; seed < tissue.cells(); ++seed) {
    if (part[static_cast<size_t>(seed)] >= 0) continue;
    const int number = static_cast<int>(result.size());
    result.emplace_back();
    part[static_cast<size_t>(seed)] = number;
    stack.push_back(seed);
    while (!stack.empty()) {
      const Index cell = stack.back();
      stack.pop_back();
      ++result.back().cells;
      for (const Index n : tissue.neighbours(cell)) {
        if (part[static_cast<size_t>(n)] >= 0) continue;
        part[static_cast<size_t>(n)] = number;
        stack.push_back(n);
      }
    }
  }
  const auto part_of = [&](Index side) -> Component& {
    return result[static_cast<size_t>(part[static_cast<size_t>(tissue.cell_of(side))])];
  };
  for (Index w = 0; w < tissue.walls(); ++w) ++part_of(tissue.wall_side(w, 0)).walls;
  for (Index j = 0; j < tissue.junctions(); ++j) ++part_of(tissue.junction_side(j)).junctions;
  // Border lines: from a border side, the next one starts where it ends.
  std::vector<char> seen(static_cast<size_t>(tissue.sides()), 0);
  for (Index s = 0; s < tissue.sides() && tissue.has_geometry(); ++s) {
    if (tissue.opposite(s) != none || seen[static_cast<size_t>(s)]) continue;
    ++part_of(s).borders;
    Index walk = s;
    do {
      seen[static_cast<size_t>(walk)] = 1;
      walk = tissue.next(walk);
      while (tissue.opposite(walk) != none) walk = tissue.next(tissue.opposite(walk));
    } while (!seen[static_cast<size_t>(walk)]);
  }
  return result;
}

}  // namespace tunica
