// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "base/bytes.h"
#include "tissue/column.h"

namespace tunica {

using Vec3 = Eigen::Vector3d;
using Index = int32_t;  ///< dense index of an element of one kind; changes with topology
using Id = uint32_t;    ///< identity of an element: never reused, never changed
inline constexpr Index none = -1;
struct FourOutlines;

/// A complex of cells. A cell is a cyclic list of sides (counter-clockwise seen from outside); a side is a wall seen
/// from one of its cells; a wall has one side (border) or two; with geometry, sides run between junctions. A tissue
/// without geometry (line, ring, grid, cylinder) has cells, walls and sides only, and no border walls.
///
/// Indices are dense (0 .. count-1) and serve the kernel within one topology; identities name elements for good.
/// Structural changes are made by the free functions in topology.h, division.h, builders.h.
///
/// Area and centroid of a cell: of a flat cell, the exact ones of the polygon, whatever its form (in the plane z = 0
/// the area is negative where the polygon runs clockwise). Of a cell that is not flat, those of a fan of triangles: the
/// centroid by the fan around the average of its junctions, the area by the fan around that centroid. MorphoGraphX
/// meshes have the same centre, so a traced cell has the area that MorphoGraphX states.
class Tissue {
 public:
  explicit Tissue(bool geometry, uint64_t seed = 1);

  // === Elements
  Index count(Kind kind) const { return static_cast<Index>(ids_[static_cast<int>(kind)].size()); }
  Index cells() const { return count(Kind::cell); }
  Index walls() const { return count(Kind::wall); }
  Index sides() const { return count(Kind::side); }
  Index junctions() const { return count(Kind::junction); }
  bool has_geometry() const { return geometry_; }
  uint64_t seed() const { return seed_; }  ///< for the random numbers of this tissue (thresholds, noise)

  Id id(Kind kind, Index index) const { return ids_[static_cast<int>(kind)][static_cast<size_t>(index)]; }
  /// The largest identity given so far to an element of this kind.
  Id last_id(Kind kind) const { return static_cast<Id>(index_of_[static_cast<int>(kind)].size() - 1); }
  /// Index of an element, or none if it is gone.
  Index find(Kind kind, Id id) const;
  /// What became of an element that is gone: "has divided into 23 and 24", "was removed", "does not exist".
  std::string fate(Kind kind, Id id) const;

  // === Cyclic neighbourhoods (arguments are valid indices; not checked)
  Index first_side(Index cell) const { return cell_side_[cell]; }  ///< none only for a lone cell of a graph
  Index next(Index side) const { return side_[side].next; }
  Index previous(Index side) const { return side_[side].previous; }
  Index cell_of(Index side) const { return side_[side].cell; }
  Index wall_of(Index side) const { return side_[side].wall; }
  Index wall_side(Index wall, int which) const {
    return wall_side_[2 * wall + which];
  }                                                            ///< [0] always; [1] none at the border
  Index opposite(Index side) const;                            ///< the wall's other side, or none
  Index neighbour(Index side) const;                           ///< the cell across, or none
  Index start(Index side) const { return side_[side].start; }  ///< junction where the side begins (with geometry)
  Index end(Index side) const { return side_[side_[side].next].start; }
  Index junction_side(Index junction) const { return junction_side_[junction]; }  ///< some side that starts here

  /// Neighbouring cells in cyclic order: once per cell, even across several walls; borders left out.
  std::vector<Index> neighbours(Index cell) const;
  bool on_border(Index cell) const;
  int side_count(Index cell) const;

  // === Geometry (only with has_geometry())
  const Vec3& position(Index junction) const { return position_[junction]; }
  /// Moves a junction. The caller calls refresh_geometry() when it has moved all.
  void set_position(Index junction, const Vec3& p) { position_[junction] = p; }
  void swap_positions(std::vector<Vec3>& positions) { position_.swap(positions); }  ///< of all: one for each junction
  /// Recomputes area, centroid and lengths of everything / of one cell and its walls. Nothing without geometry.
  void refresh_geometry();
  void refresh_geometry(Index cell);
  /// The first, and which cells are not plain beyond doubt (is_plain_cell in polygon.h). @param outward  of each cell
  void refresh_geometry(const std::vector<Vec3>& outward, std::vector<Index>& doubtful);
  double area(Index cell) const { return area_->values[cell]; }
  double length(Index wall) const { return length_->values[wall]; }
  Vec3 centroid(Index cell) const { return {x_->values[cell], y_->values[cell], z_->values[cell]}; }
  Vec3 normal(Index cell) const;  ///< unit, from the polygon's vector area
  std::vector<Vec3> polygon(Index cell) const;
  void collect_polygon(Index cell, std::vector<Vec3>& points) const;  ///< the same into `points`; with geometry only

  // === Columns. Built in: cell area x y z, wall length (with geometry); cell row, column (line, ring, grid, cylinder).
  Column& add_column(Kind kind, Column column);  ///< errors: name taken, not an identifier
  Column* find_column(Kind kind, std::string_view name);
  const Column* find_column(Kind kind, std::string_view name) const;
  Column& column(Kind kind, std::string_view name);  ///< errors: unknown (names the nearest)
  const std::vector<std::unique_ptr<Column>>& columns(Kind kind) const { return columns_[static_cast<int>(kind)]; }

  // === Versions: a number that changes when the structure, or positions and lengths, change
  uint64_t topology_version() const { return topology_version_; }
  uint64_t geometry_version() const { return geometry_version_; }
  bool locked() const { return locked_; }  ///< while rules run: structural changes are errors
  void lock(bool on) { locked_ = on; }

  // === Whole state
  void save(ByteWriter& out) const;  ///< structure, geometry, columns, identities, fates: the same bits after load
  void load(ByteReader& in);         ///< replaces everything; errors: damaged data (checked by validate)
  std::string hash() const;          ///< of what save writes

 private:
  friend class TissueEditor;  ///< topology.h: the only code that changes structure

  bool geometry_;
  bool locked_ = false;
  uint64_t seed_;
  uint64_t topology_version_ = 1, geometry_version_ = 1;
  std::array<std::vector<Id>, kinds> ids_;
  std::array<std::vector<int64_t>, kinds> index_of_;  ///< by identity: index, or a coded fate
  struct Side {                                       // together, because a walk needs them together
    Index next, previous, cell, wall, start;
  };
  std::vector<Side> side_;
  std::vector<Index> cell_side_, wall_side_, junction_side_;
  std::vector<Vec3> position_;
  std::array<std::vector<std::unique_ptr<Column>>, kinds> columns_;
  void add_geometric_columns();
  Column& own_column(Kind kind, const char* name);
  void measure_cell(Index cell, std::vector<Vec3>& points);
  void measure_walls();
  void measure_all(const std::vector<Vec3>* outward, std::vector<Index>* doubtful);
  bool collect_outlines(Index first, FourOutlines& outlines) const;
  void load_kind(ByteReader& in, Kind kind);
  void refresh_after_load();
  void adopt(Tissue&& fresh);

  Column *area_ = nullptr, *x_ = nullptr, *y_ = nullptr, *z_ = nullptr, *length_ = nullptr;
};

inline Index Tissue::opposite(Index side) const {
  const Index wall = side_[side].wall;
  return wall_side_[2 * wall + (wall_side_[2 * wall] == side ? 1 : 0)];
}
inline Index Tissue::neighbour(Index side) const {
  const Index other = opposite(side);
  return other == none ? none : side_[other].cell;
}

}  // namespace tunica
