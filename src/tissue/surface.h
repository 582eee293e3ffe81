// SPDX-License-Identifier: MIT
#pragma once

#include <span>

#include "tissue/tissue.h"

namespace tunica {

/// A growing surface that a tissue lies on: the two operations of thesis 10.2, and the outward normal.
class Surface {
 public:
  virtual ~Surface() = default;
  /// Where a point that is on the surface at time t will be at t + dt.
  virtual Vec3 advance(const Vec3& p, double t, double dt) const = 0;
  /// The point of the surface closest to a point in space.
  virtual Vec3 closest(const Vec3& p) const = 0;
  /// A point of the surface next to one that is close to it, as a chord between two of its points is: where the closest
  /// one is dear, not quite that.
  virtual Vec3 onto(const Vec3& p) const { return closest(p); }
  /// Outward unit normal where the surface is closest to a point.
  virtual Vec3 normal(const Vec3& p) const = 0;
  /// The same of any length, to within some degrees: for what only asks which side is outward.
  virtual Vec3 facing(const Vec3& p) const { return normal(p); }
  /// The same of many points, each of which is replaced by the answer.
  virtual void advance_all(std::span<Vec3> points, double t, double dt) const;
  virtual void facing_all(std::span<Vec3> points) const;
  /// Whether it is known which side is outward. If not, normal() is an error, and cells keep facing where they do.
  virtual bool has_outside() const { return true; }
};

/// Where every junction will be when the surface has grown from time t on for dt. The tissue is locked meanwhile: the
/// surface may be a script. Errors: t or dt not finite; no geometry; locked; what the surface throws.
std::vector<Vec3> advanced(Tissue& tissue, const Surface& surface, double t, double dt);

/// Moves every junction along with the surface and measures the tissue anew. Checks each cell: its area is positive,
/// its polygon does not cross itself, it is not turned over. If anything fails the tissue stays as it was. Errors:
/// those of advanced(); a cell that would be impossible (named).
void grow(Tissue& tissue, const Surface& surface, double t, double dt);

/// Puts the junctions at these positions (one each), with the checks and guarantees of grow().
/// @param surface  for the outward side; nullptr, or no outside known: a cell may not turn over against where it faces
/// now
void move_junctions(Tissue& tissue, std::vector<Vec3> positions, const Surface* surface = nullptr);

}  // namespace tunica
