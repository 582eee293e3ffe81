// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <functional>
#include <memory>
#include <vector>

#include "tissue/surface.h"

namespace tunica {

/// A surface out of which primordia bulge (thesis 5.5, fig. 5.8). Each is born at a place of the base surface, is
/// carried along by its growth, and has a radius r and a height H by its age. Base points nearer than r (straight
/// distance d) to its centre are lifted along the base's normal by H (1 - (d/r)^2)^2: no kink at the rim. Where several
/// overlap the highest counts, smoothly: the lift is (sum of h_i^8)^(1/8), so two that are equal lift by 1.09 of one.
///
/// A point of this surface is base point + lift x normal; its base point is the base's closest point to it. This holds
/// as long as lifts stay below the radius of curvature wherever the base is hollow.
///
/// closest() and normal() are about the surface at time(); advance() about the times it is given. The surface stands
/// still while a const function runs.
class Bulges : public Surface {
 public:
  using OfAge = std::function<double(double age)>;
  struct Primordium {
    Vec3 place;    ///< on the base, at birth
    double birth;  ///< time
  };
  /// A primordium at some time.
  struct Bump {
    size_t which;  ///< in primordia()
    Vec3 centre;   ///< on the base
    double radius, height;
  };

  /// Errors: no base or function; a base without a known outside.
  Bulges(std::shared_ptr<const Surface> base, OfAge radius, OfAge height);

  const Surface& base() const { return *base_; }
  /// The place is put onto the base. Errors: not finite.
  void add(const Vec3& place, double birth);
  void set_primordia(std::vector<Primordium> primordia);
  const std::vector<Primordium>& primordia() const { return primordia_; }

  /// Errors: not finite; a radius or height that is negative or not finite; what the functions throw.
  void set_time(double t);
  double time() const { return now_.time; }
  /// Those born by now whose radius is not 0.
  const std::vector<Bump>& bumps() const { return now_.bumps; }

  Vec3 advance(const Vec3& p, double t, double dt) const override;
  void advance_all(std::span<Vec3> points, double t, double dt) const override;
  void facing_all(std::span<Vec3> points) const override;
  /// To 1e-6 of the smallest radius near it, or to the base's own accuracy where nothing bulges. Far from the surface
  /// it is the best found from several starts.
  Vec3 closest(const Vec3& p) const override;
  /// The point above the base point of p.
  Vec3 onto(const Vec3& p) const override { return lifted(base_->closest(p)); }
  /// Of the point above the base point of p: exact for points of the surface, cheap and near enough for those close to
  /// it.
  Vec3 normal(const Vec3& p) const override;
  Vec3 facing(const Vec3& p) const override { return now_.flat ? base_->facing(p) : normal(p); }

  /// The point above a base point, now.
  Vec3 lifted(const Vec3& base_point) const { return lifted(now_, base_point); }
  /// How far a base point is lifted now.
  double height(const Vec3& base_point) const { return height(now_, base_point); }
  /// The bump, now, in whose radius a point of the surface lies most deeply: least distance of its base point from the
  /// centre as a fraction of the radius (d_i / r in 5.10, 5.11); nullptr: outside all.
  const Bump* bump_at(const Vec3& p, double* fraction = nullptr) const;
  /// The same of `count` points: number of the primordium, from 1, 0 outside all; and depth, 1 - that fraction.
  void deepest(const double* x, const double* y, const double* z, size_t count, double* primordium,
               double* depth) const;

 private:
  struct State {
    double time = 0;
    std::vector<Bump> bumps;
    bool flat = true;  ///< no height anywhere: the surface is its base, and primordia are only places on it
  };
  struct Chart;
  State state_at(double t) const;
  const State& cached(double t) const;
  double height(const State& state, const Vec3& base_point, Vec3* gradient = nullptr) const;
  Vec3 lifted(const State& state, const Vec3& base_point) const;
  Vec3 search(const Vec3& p, const Vec3& start, double scale) const;
  Vec3 base_of_closest(const Vec3& p) const;
  double scale_at(const Vec3& base_point) const;

  std::shared_ptr<const Surface> base_;
  OfAge radius_, height_;
  std::vector<Primordium> primordia_;
  State now_;
  mutable std::array<State, 2> recent_;  ///< the ends of the last growth step, asked for by every junction
  mutable size_t recent_count_ = 0;
};

/// grow() for a surface that bulges, from its time() on; its time is then later by dt. If that fails the tissue and the
/// surface stay as they were.
void grow(Tissue& tissue, Bulges& surface, double dt);

/// Adds columns `primordium` (number of the one in which the centroid lies most deeply, from 1; 0: outside all) and
/// `closeness` (1 at its centre to 0 at its rim and outside: 1 - d/r of 5.10, 5.11) to the cells where they are
/// missing, and sets them. Errors: no geometry.
void differentiate(Tissue& tissue, const Bulges& surface);

}  // namespace tunica
