// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <map>
#include <string>

#include "base/cancel.h"
#include "base/error.h"
#include "tissue/surface.h"

namespace tunica {

/// A tentative dividing wall: straight, from a point of one side of a cell to a point of another. Places on a side are
/// fractions of its length from its start, 0..1.
struct Cut {
  Index side_a = none;
  double at_a = 0;
  Index side_b = none;
  double at_b = 0;
};

/// A division rule: where a cell is to be divided. Errors thrown by it leave the tissue as it was.
using DivisionRule = std::function<Cut(const Tissue&, Index cell)>;

// All rules work on the cell's polygon seen along its normal, in its mean plane (the plane itself for a flat cell).

/// Errera (1888), thesis 3.4: the shortest wall through the centroid, minimised exactly. Of the line through the
/// centroid the wall is the piece inside the cell that has the centroid on it. Where a cell is so bent that its
/// centroid lies outside: the shortest piece inside the cell, on any line through the centroid, that leaves at least a
/// fifth of the area on either side (if there is none, a tenth, a twentieth, ...).
Cut errera(const Tissue& tissue, Index cell);
/// Nakielski (2000), thesis fig. 3.8a: along the line through the centroid and the nearest point of the cell's walls.
/// Of that line, the piece that has the centroid on it; if the centroid lies outside, the piece that halves the cell
/// best.
Cut closest_wall(const Tissue& tissue, Index cell);
/// Along the line through the centroid that is parallel to a direction (projected into the cell's mean plane); pieces
/// as for closest_wall. Errors: a direction without length, or (when used) at right angles to the cell.
DivisionRule along(const Vec3& direction);
/// The cut whose ends are the points of the cell's walls nearest to two points in space. Errors: points not finite,
/// both nearest to the same wall, or farther from the cell than it is wide.
Cut cut_between(const Tissue& tissue, Index cell, const Vec3& p, const Vec3& q);
/// "errera", "closest_wall". Errors: unknown (names the nearest).
DivisionRule division_rule(const std::string& name);

/// How a wall is laid once its rule has said where (thesis 3.4, fig. 3.7 c and d). The defaults, with that of
/// Threshold, were chosen so that a growing sheet comes near the Arabidopsis apex in shares of 5-, 6-, 7-sided cells
/// and spread of areas: a wider threshold makes more 5-sided cells, a wider gap more 7-sided ones, pinching more
/// 6-sided ones.
struct DivisionSettings {
  double gap = -1;             ///< least distance of a new wall's ends from junctions, a length; < 0: by gap_fraction
  double gap_fraction = 0.25;  ///< the same as a fraction of the square root of the cell's area
  double pinch = 0.04;  ///< both ends move so far towards each other, as a fraction of the wall; not at the border
};

struct Division {
  Index first, second;  ///< the daughters; the first has the mother's index
  Index wall;           ///< between them
};

/// A cell cannot be divided where its rule says: what came of it would be no cell.
class Indivisible : public Error {
 public:
  using Error::Error;
};

/// What could not be divided while many cells were, which does not keep the others from it.
class Undivided {
 public:
  void add(Id cell, const Indivisible& error) { messages_[cell] = error.what(); }
  void remove(Id cell) { messages_.erase(cell); }  ///< it went at another try, its neighbours having divided
  /// Errors: if there are any, with the cell of the lowest identity, their number, and what was done.
  void report(int64_t divisions) const;

 private:
  std::map<Id, std::string> messages_;
};

/// Divides a cell. The ends of the new wall are displaced along the cell's outline to keep the gap from where three or
/// more walls meet and from corners (at most .45 of the wall they are on), so four walls never meet in one point; then
/// the wall is pinched, and its ends put onto the surface if there is one. If that makes an impossible cell (no area,
/// crossing itself) of a daughter or a neighbour, it is tried without pinching, then with a smaller gap.
/// Columns: the daughters get what each column's Inherit says, likewise the parts of the two walls and their sides; the
/// new wall, its sides and junctions get initial values. Time is proportional to the cells touched.
/// Errors: the cut is not one of this cell; no possible division there (Indivisible); locked; what a column's rule
/// throws. The tissue is then as it was.
Division divide(Tissue& tissue, Index cell, const Cut& cut, const DivisionSettings& settings = {},
                const Surface* surface = nullptr);
Division divide(Tissue& tissue, Index cell, const DivisionRule& rule, const DivisionSettings& settings = {},
                const Surface* surface = nullptr);

struct Threshold {
  double area = 1;          ///< a cell divides when its area is above this ...
  double variation = 0.3;   ///< ... times 1 + variation u, u uniform in -1..1, fixed for each identity and tissue seed
  int64_t most_cells = -1;  ///< stop when the tissue has so many; < 0: no limit
};

/// The area above which a cell divides.
double threshold_of(const Tissue& tissue, Index cell, const Threshold& threshold);

/// Divides every cell above its threshold, until none is; in order of identity, so daughters last. When the tissue
/// grows past 1000, 1250, 1562, ... cells it is renumbered along a curve (order.h) at the end. Errors: settings out of
/// range; no geometry; those of divide(), with what is divided by then done, Indivisible only when all others are
/// divided (Undivided); Cancelled, between two divisions.
/// @param changed  gets the cells that were made or have another shape now; some may have divided since
/// @return how many divisions
int64_t divide_above(Tissue& tissue, const Threshold& threshold, const DivisionRule& rule,
                     const DivisionSettings& settings = {}, const Surface* surface = nullptr,
                     const CancelFlag* cancel = nullptr, std::vector<Id>* changed = nullptr);

}  // namespace tunica
