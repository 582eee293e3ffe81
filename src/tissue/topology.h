// SPDX-License-Identifier: MIT
#pragma once

#include <utility>
#include <vector>

#include "tissue/tissue.h"

namespace tunica {

/// Keeps a tissue locked while code that is not the kernel's runs (a division rule, a column's rule, a velocity field).
class LockWhile {
 public:
  explicit LockWhile(Tissue& tissue) : tissue_(tissue), before_(tissue.locked()) { tissue_.lock(true); }
  ~LockWhile() { tissue_.lock(before_); }
  LockWhile(const LockWhile&) = delete;
  LockWhile& operator=(const LockWhile&) = delete;

 private:
  Tissue& tissue_;
  bool before_;
};

/// What the two parts of a dividing element get, one pair for each column of its kind.
using Parts = std::vector<std::pair<double, double>>;

/// Works out the parts of a dividing element by each column's own inheritance. Changes nothing; a column's rule is run
/// with the tissue locked.
/// @param share  the first part's share of area (cells) or length (walls, sides), in 0..1
/// Errors: what a rule throws; a rule that is missing (after loading) or gives something that is not a number.
Parts parts_of(Tissue& tissue, Kind kind, Index element, double share);

struct Measure;

/// The only code that changes the structure of a tissue. Each operation leaves columns, identities, fates and versions
/// right; operations that leave the complex half-built (add, link) are for builders, which finish it.
/// Arguments are valid indices; they are not checked here. Errors: the tissue is locked; more elements than it can
/// hold.
class TissueEditor {
 public:
  explicit TissueEditor(Tissue& tissue);

  // === Building
  Index add_cell();
  Index add_junction(Vec3 position);  ///< by value: it may be a position of this tissue
  Index add_wall();
  /// Adds a side to a cell's cycle before the side `before` (none: before first_side, which is the end of the cycle),
  /// and to the wall. With `lead`, the new side becomes the cell's first_side.
  Index add_side(Index cell, Index wall, Index start = none, Index before = none, bool lead = false);
  /// Rotates a cell's cycle so that it starts at `side`.
  void set_first_side(Index side) { t_.cell_side_[t_.side_[side].cell] = side; }
  /// Puts the sides of a cell, all of them and no others, into this cyclic order.
  void set_order(Index cell, const std::vector<Index>& sides);
  void set_place(Index cell, double row, double column);  ///< of a tissue without geometry
  /// Gives every fan of cells that meet in one junction only there a junction of its own.
  void separate_fans();

  // === Dividing
  /// Puts a junction into a wall. The wall and its sides are split into two each, with new identities: the first part
  /// of a wall runs from its side [0]'s start to the junction, the first part of a side from the side's start. The
  /// first parts of wall and side [0] keep the index.
  /// @param legacy  what the parts get: of the wall, side [0], side [1] (empty at the border)
  /// @return the junction; the side that starts there in the cell of side [0] is junction_side()
  Index split_wall(Index wall, const Vec3& position, const std::array<Parts, 3>& legacy);
  /// Lays a wall between the junctions where two sides of a cell start. The first daughter has the cell's index and
  /// first_side, the second is appended; both get new identities.
  /// @param legacy  what the daughters get, in this order
  /// @return the new wall; its side [0] is in the first daughter, side [1] in the second
  Index split_cell(Index side_a, Index side_b, const Parts& legacy);
  /// What a cell measures that was split, or got a junction. Its new walls are measured already.
  void set_measure(Index cell, const Measure& measure);

  // === Removing
  /// Removes a cell, its sides, the walls that no other cell has and the junctions that no side starts at. Walls that
  /// it shared become border walls, or go, without geometry. Cells that hang together at one junction only are parted
  /// there.
  void remove_cell(Index cell);
  /// Without geometry: removes a wall and its sides.
  void remove_wall(Index wall);

  // === Renumbering
  /// Element order[i] gets index i. `order` must be a permutation of 0..count-1.
  void renumber(Kind kind, const std::vector<Index>& order);

  // === Whole state (for Tissue::load)
  void require_room(Kind kind, size_t more) const;

 private:
  Index append(Kind kind);
  void renew(Kind kind, Index index);
  Index split_off(Kind kind, Index index, const Parts& legacy);
  void measure_wall(Index wall);
  void link(Index side, Index following);
  void detach_side(Index side);
  void erase(Kind kind, Index index);
  void erase_all(Kind kind, std::vector<Index>& indices);
  void move_last_to(Kind kind, Index hole);
  void move_side(Index last, Index hole);
  void set_start(Index first, Index junction);
  void give_own_junction(Index first);
  bool leave_junction(Index side);

  Tissue& t_;
  std::vector<Index> dead_sides_, dead_walls_, dead_junctions_;  ///< of a removal; kept for the next one's
};

/// The sides that start at a junction, counter-clockwise seen from outside, from the border if it is there. In a valid
/// tissue, all of them.
std::vector<Index> sides_at(const Tissue& tissue, Index junction);
/// The first of them; and the one after a side, none at the border.
Index first_side_at(const Tissue& tissue, Index junction);
inline Index side_after(const Tissue& tissue, Index side) { return tissue.opposite(tissue.previous(side)); }
/// Number of walls that meet in a junction.
int degree(const Tissue& tissue, Index junction);
/// The side of cell `a` that faces cell `b`, or none.
Index side_between(const Tissue& tissue, Index a, Index b);
/// The neighbour after (before) `n` in the cycle of `cell`: VV's nextto, prevto. Borders are left out. Errors: `n` is
/// not a neighbour.
Index next_to(const Tissue& tissue, Index cell, Index n);
Index previous_to(const Tissue& tissue, Index cell, Index n);

/// Removes a cell (ablation). Works with and without geometry. Errors: locked.
void remove_cell(Tissue& tissue, Index cell);
/// Removes several cells, in the order of their identities. Time is proportional to the cells removed. Errors: locked;
/// one of them is not there; nothing would be left. The tissue is then as it was.
void remove_cells(Tissue& tissue, std::vector<Id> cells);

// === Graphs: tissues without geometry (VV's splice, make nb_of). Errors: the tissue has geometry, is locked.

/// A cell without neighbours.
Index add_cell(Tissue& graph);
/// Where a new neighbour comes in a cell's cycle: after or before a neighbour, or last.
struct Place {
  enum Where { last, after, before } where = last;
  Index neighbour = none;
};
/// Makes two cells neighbours. Errors: a == b, they are neighbours already, a Place names a cell that is no neighbour.
/// @return the wall
Index join(Tissue& graph, Index a, Index b, Place in_a = {}, Place in_b = {});
/// Makes two neighbours strangers. Errors: they are not neighbours.
void separate(Tissue& graph, Index a, Index b);
/// Makes `neighbours`, in this cyclic order, the neighbours of a cell: missing ones are joined (last in their own
/// cycle), others separated. Errors: the cell itself or a cell twice among them.
void set_neighbours(Tissue& graph, Index cell, const std::vector<Index>& neighbours);

}  // namespace tunica
