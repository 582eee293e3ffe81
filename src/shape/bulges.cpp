// SPDX-License-Identifier: MIT
#include "shape/bulges.h"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <cmath>

#include "base/error.h"
#include "shape/apex_kernels.h"

namespace tunica {

Bulges::Bulges(std::shared_ptr<const Surface> base, OfAge radius, OfAge height)
    : base_(std::move(base)), radius_(std::move(radius)), height_(std::move(height)) {
  if (!base_ || !radius_ || !height_) fail("a surface that bulges needs a base, and radius and height by age");
  if (!base_->has_outside()) fail("a surface that bulges needs a base with a normal: which side is outward?");
}

void Bulges::add(const Vec3& place, double birth) {
  if (!place.allFinite() || !std::isfinite(birth))
    fail("place and birth of a primordium must be finite, not ({}, {}, {}) and {}", place.x(), place.y(), place.z(),
         birth);
  std::vector<Primordium> more = primordia_;
  more.push_back({base_->closest(place), birth});
  set_primordia(std::move(more));
}

void Bulges::set_primordia(std::vector<Primordium> primordia) {
  std::swap(primordia_, primordia);
  try {
    now_ = state_at(now_.time);
  } catch (...) {
    std::swap(primordia_, primordia);
    throw;
  }
  recent_count_ = 0;
}

void Bulges::set_time(double t) {
  if (!std::isfinite(t)) fail("the time of a surface must be finite, not {}", t);
  if (t != now_.time) now_ = State(cached(t));
}

Bulges::State Bulges::state_at(double t) const {
  State state{t, {}, true};
  for (size_t i = 0; i < primordia_.size(); ++i) {
    const double age = t - primordia_[i].birth;
    if (!(age >= 0)) continue;
    const double radius = radius_(age), height = height_(age);
    if (!(radius >= 0 && height >= 0) || !std::isfinite(radius) || !std::isfinite(height))
      fail("radius and height of a primordium must be 0 or more; at age {} they are {} and {}", age, radius, height);
    state.flat = state.flat && !(radius > 0 && height > 0);
    if (radius > 0)
      state.bumps.push_back({i, base_->advance(primordia_[i].place, primordia_[i].birth, age), radius, height});
  }
  return state;
}

const Bulges::State& Bulges::cached(double t) const {
  if (t == now_.time) return now_;
  for (size_t i = 0; i < std::min<size_t>(recent_count_, 2); ++i)
    if (recent_[i].time == t) return recent_[i];
  State& slot = recent_[recent_count_++ % 2];
  slot = state_at(t);
  return slot;
}

double Bulges::height(const State& state, const Vec3& base_point, Vec3* gradient) const {
  if (gradient) *gradient = Vec3::Zero();
  double most = 0, sum = 0;
  const auto each = [&](auto&& take) {
    for (const Bump& bump : state.bumps) {
      const double inside = 1 - (base_point - bump.centre).squaredNorm() / (bump.radius * bump.radius);
      if (inside > 0) take(bump, inside);
    }
  };
  each([&](const Bump& bump, double inside) { most = std::max(most, bump.height * inside * inside); });
  if (most == 0) return 0;
  each([&](const Bump& bump, double inside) { sum += std::pow(bump.height * inside * inside / most, 8); });
  const double h = most * std::pow(sum, 1. / 8);
  if (gradient)
    each([&](const Bump& bump, double inside) {
      const double weight = std::pow(bump.height * inside * inside / h, 7);
      *gradient -= weight * 4 * bump.height * inside / (bump.radius * bump.radius) * (base_point - bump.centre);
    });
  return h;
}

Vec3 Bulges::lifted(const State& state, const Vec3& base_point) const {
  const double h = state.flat ? 0 : height(state, base_point);
  return h > 0 ? Vec3(base_point + h * base_->normal(base_point)) : base_point;
}

Vec3 Bulges::advance(const Vec3& p, double t, double dt) const {
  // The later state is asked for first: asking for it may not push the earlier one out.
  const State& later = cached(t + dt);
  if (later.flat && cached(t).flat) return base_->advance(p, t, dt);
  const Vec3 moved = base_->advance(base_->closest(p), t, dt);
  return lifted(cached(t + dt), moved);
}

void Bulges::advance_all(std::span<Vec3> points, double t, double dt) const {
  const bool flat = cached(t + dt).flat && cached(t).flat;
  flat ? base_->advance_all(points, t, dt) : Surface::advance_all(points, t, dt);
}

void Bulges::facing_all(std::span<Vec3> points) const {
  now_.flat ? base_->facing_all(points) : Surface::facing_all(points);
}

const Bulges::Bump* Bulges::bump_at(const Vec3& p, double* fraction) const {
  const Vec3 b = now_.flat ? p : base_->closest(p);
  const Bump* found = nullptr;
  double least = 1;
  for (const Bump& bump : now_.bumps) {
    const double here = (b - bump.centre).squaredNorm() * (1 / (bump.radius * bump.radius));
    if (!(here < least)) continue;
    least = here;
    found = &bump;
  }
  least = std::sqrt(least);
  if (found && fraction) *fraction = least;
  return found;
}

void Bulges::deepest(const double* x, const double* y, const double* z, size_t count, double* bump,
                     double* depth) const {
  std::vector<double> on_base;
  if (!now_.flat) {
    on_base.resize(3 * count);
    for (size_t i = 0; i < count; ++i) {
      const Vec3 b = base_->closest({x[i], y[i], z[i]});
      for (size_t axis = 0; axis < 3; ++axis) on_base[axis * count + i] = b[static_cast<Eigen::Index>(axis)];
    }
    x = on_base.data(), y = x + count, z = y + count;
  }
  std::vector<Disc> discs;
  for (const Bump& b : now_.bumps)
    discs.push_back({b.centre.x(), b.centre.y(), b.centre.z(), 1 / (b.radius * b.radius)});
  apex_kernels().deepest(discs.data(), static_cast<int>(discs.size()), x, y, z, static_cast<long>(count), bump, depth);
  for (size_t i = 0; i < count; ++i)  // the number in the list becomes that of the primordium
    if (bump[i] > 0) bump[i] = static_cast<double>(now_.bumps[static_cast<size_t>(bump[i]) - 1].which + 1);
}

// === The closest point: Newton's method for |S(b) - p|^2 over base points b = closest(b0 + u e + v f) around b0

struct Bulges::Chart {
  const Bulges& surface;
  Vec3 origin, normal, e, f;
  double step;  ///< of differences

  Chart(const Bulges& s, const Vec3& base_point, double scale)
      : surface(s), origin(base_point), normal(s.base_->normal(base_point)), step(3e-4 * scale) {
    int least = 0;
    normal.cwiseAbs().minCoeff(&least);
    e = (Vec3::Unit(least) - normal[least] * normal).normalized();
    f = normal.cross(e);
  }
  Vec3 base(double u, double v) const { return surface.base_->closest(origin + u * e + v * f); }
  Vec3 at(double u, double v) const { return surface.lifted(base(u, v)); }
  /// dS along a direction. Differences are of the base only: second derivatives of the lift jump at rims.
  Vec3 tangent(const Vec3& direction) const {
    const Vec3 ahead = surface.base_->closest(origin + step * direction);
    const Vec3 behind = surface.base_->closest(origin - step * direction);
    const Vec3 along = (ahead - behind) / (2 * step);
    Vec3 gradient;
    const double h = surface.height(surface.now_, origin, &gradient);
    if (h == 0) return along;
    const Vec3 turn = (surface.base_->normal(ahead) - surface.base_->normal(behind)) / (2 * step);
    return along + gradient.dot(along) * normal + h * turn;
  }
};

/// The smallest radius whose bump may matter near a base point; 0: none.
double Bulges::scale_at(const Vec3& base_point) const {
  double scale = 0;
  for (const Bump& bump : now_.bumps)
    if (bump.height > 0 && (base_point - bump.centre).norm() < 1.5 * bump.radius && (scale == 0 || bump.radius < scale))
      scale = bump.radius;
  return scale;
}

Vec3 Bulges::search(const Vec3& p, const Vec3& start, double scale) const {
  Vec3 b = start;
  double distance = (lifted(b) - p).squaredNorm();
  for (int iteration = 0; iteration < 60; ++iteration) {
    const Chart chart(*this, b, scale);
    const double d = chart.step;
    const Vec3 here = chart.at(0, 0), off = here - p;
    const Vec3 right = chart.at(d, 0), left = chart.at(-d, 0), up = chart.at(0, d), down = chart.at(0, -d);
    const Vec3 su = chart.tangent(chart.e), sv = chart.tangent(chart.f);
    const Vec3 suu = (right - 2 * here + left) / (d * d), svv = (up - 2 * here + down) / (d * d);
    const Vec3 suv = (chart.at(d, d) - chart.at(d, -d) - chart.at(-d, d) + chart.at(-d, -d)) / (4 * d * d);
    const Eigen::Vector2d gradient(su.dot(off), sv.dot(off));
    Eigen::Matrix2d hessian;
    hessian << su.dot(su) + suu.dot(off), su.dot(sv) + suv.dot(off), su.dot(sv) + suv.dot(off),
        sv.dot(sv) + svv.dot(off);
    // Made positive definite, the step leads downhill from wherever it starts.
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> eigen(hessian);
    const double floor = .05 * (su.squaredNorm() + sv.squaredNorm());
    const Eigen::Vector2d strength = eigen.eigenvalues().cwiseAbs().cwiseMax(floor);
    Eigen::Vector2d move =
        -eigen.eigenvectors() * (eigen.eigenvectors().transpose() * gradient).cwiseQuotient(strength);
    if (move.norm() > .3 * scale) move *= .3 * scale / move.norm();
    const double before = distance;
    Vec3 next = b;
    for (int halving = 0; halving < 30; ++halving, move /= 2) {
      next = chart.base(move.x(), move.y());
      distance = (lifted(next) - p).squaredNorm();
      if (distance <= before || move.norm() < 1e-12 * scale) break;
    }
    if (distance > before) return b;
    b = next;
    if (move.norm() < 1e-10 * scale) break;
  }
  return b;
}

Vec3 Bulges::base_of_closest(const Vec3& p) const {
  Vec3 best = base_->closest(p);
  double least = (lifted(best) - p).norm();
  const auto offer = [&](const Vec3& start, double scale) {
    const Vec3 found = search(p, start, scale);
    const double distance = (lifted(found) - p).norm();
    if (distance < least) best = found, least = distance;
  };
  // A point of the surface itself is above its base point, and there is nothing to search for.
  const double scale = scale_at(best);
  if (scale > 0 && least > 1e-9 * scale) offer(best, scale);
  for (const Bump& bump : now_.bumps)
    if (bump.height > 0 && least > 1e-9 * bump.radius &&
        (p - bump.centre).norm() - bump.radius - 1.5 * bump.height < least)
      offer(bump.centre, bump.radius);
  return best;
}

Vec3 Bulges::closest(const Vec3& p) const { return lifted(base_of_closest(p)); }

Vec3 Bulges::normal(const Vec3& p) const {
  if (now_.flat) return base_->normal(p);
  const Vec3 b = base_->closest(p), outward = base_->normal(b);
  const double scale = scale_at(b);
  if (scale == 0) return outward;
  const Chart chart(*this, b, scale);
  const Vec3 n = chart.tangent(chart.e).cross(chart.tangent(chart.f));
  const double length = n.norm();
  if (!(length > 0)) return outward;
  return n.dot(outward) < 0 ? Vec3(-n / length) : Vec3(n / length);
}

void grow(Tissue& tissue, Bulges& surface, double dt) {
  const double before = surface.time();
  std::vector<Vec3> positions = advanced(tissue, surface, before, dt);
  surface.set_time(before + dt);
  try {
    move_junctions(tissue, std::move(positions), &surface);
  } catch (...) {
    surface.set_time(before);
    throw;
  }
}

void differentiate(Tissue& tissue, const Bulges& surface) {
  if (!tissue.has_geometry()) fail("cells without geometry are in no primordium");
  const auto column = [&](const char* name) -> Column& {
    if (Column* there = tissue.find_column(Kind::cell, name)) return *there;
    Column made;
    made.name = name;
    return tissue.add_column(Kind::cell, std::move(made));
  };
  Column &primordium = column("primordium"), &closeness = column("closeness");
  const auto centroid = [&](const char* axis) { return tissue.column(Kind::cell, axis).values.data(); };
  surface.deepest(centroid("x"), centroid("y"), centroid("z"), static_cast<size_t>(tissue.cells()),
                  primordium.values.data(), closeness.values.data());
}

}  // namespace tunica
