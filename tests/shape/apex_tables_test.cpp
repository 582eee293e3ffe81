// SPDX-License-Identifier: MIT
#include "shape/apex_tables.h"

#include <algorithm>
#include <cstring>

#include "shape/apex.h"
#include "tissue/fixtures.h"

namespace tunica {
namespace {

using testing::Dice;

Profile dome() {
  const Vec2 tip(0, 0), end(1.4, -3);
  return Profile(
      BSpline({tip, tip, tip, {.55, 0}, {1, -.25}, {1.25, -.8}, {1.35, -1.6}, end, end, end}, 3, Ends::open));
}

std::vector<std::pair<const char*, Apex>> apices() {
  const Curve spline({{0, .25}, {1.7, .25}, {2, .2}, {2.4, .17}, {8, .17}});
  const Curve linear = Curve::linear({{0, .1}, {1, .3}, {3, 0}});
  return {
      {"cap", Apex(Profile::cap(1.5, 1.3, 9), spline)},
      {"long growth", Apex(Profile::cap(1.5, 1.3, 5), Curve({{0, .25}, {20, .2}, {40, .17}}))},
      {"steady", Apex(Profile::cap(1.5, 1.3, 5), Curve({{0, .2}, {20, .2}}))},
      {"dome", Apex(dome(), linear)},
      {"slowing", Apex(dome(), Curve({{0, .2}, {1, 1}, {2, 0}}))},
      {"constant", Apex(dome(), Curve::constant(.3))},
      {"hemisphere", Apex(Profile::cap(1, M_PI / 2, 5), spline)},
      {"corner", Apex(Profile(BSpline({{0, 0}, {1, -.2}, {1.1, -2}}, 1, Ends::clamped)), spline)},
      {"narrowing", Apex(Profile(BSpline({{0, 0}, {2, 0}, {2, -1}, {.5, -1.2}, {.5, -3}}, 3, Ends::clamped)), spline)},
      {"hole", Apex(Profile::line({1, 0}, {1.5, -4}), spline)}};
}

/// What is read from tables is what is found the longer way: for points on the surface and near it, and as they grow.
TEST(ApexTables, AgreeWithWhatTheyTabulate) {
  Dice dice(7);
  for (const auto& [name, apex] : apices()) {
    for (int i = 0; i < 3000; ++i) {
      const double theta = dice.between(-3, 3), a = 6 * std::pow(dice.real(), 2), dt = dice.between(0, 3);
      const Vec3 on = apex.position(theta, a);
      EXPECT_NEAR(apex.arc_of(on), apex.place_of(on).a, 1e-10) << name << ' ' << a;
      EXPECT_NEAR((apex.advance(on, 0, dt) - apex.position(theta, apex.after(a, dt))).norm(), 0, 1e-9 * (1 + a))
          << name << ' ' << a << ' ' << dt;
      EXPECT_NEAR((apex.closest(on) - on).norm(), 0, 1e-10) << name << ' ' << a;
      if (std::string(name) == "corner" && std::abs(a - std::hypot(1, .2)) < .5) continue;  // two places may be near
      const Vec3 off = on + Vec3(dice.between(-.1, .1), dice.between(-.1, .1), dice.between(-.1, .1));
      const Apex::Place place = apex.place_of(off);
      EXPECT_NEAR((apex.closest(off) - apex.position(place.theta, place.a)).norm(), 0, 1e-8) << name << ' ' << a;
      EXPECT_NEAR((apex.normal(off) - apex.normal(place)).norm(), 0, 1e-7) << name << ' ' << a;
    }
  }
}

/// Points asked for together get what each gets alone, with either instruction set.
TEST(ApexTables, ManyAtOnceAreAsOneByOne) {
  Dice dice(9);
  for (const auto& [name, apex] : apices()) {
    const size_t n = 1001;
    std::vector<double> x(n), y(n), z(n), theta(n), a(n);
    std::vector<Vec3> on(n);
    for (size_t i = 0; i < n; ++i) {
      on[i] = apex.position(dice.between(-3, 3), i == 0 ? 0 : 6 * std::pow(dice.real(), 2));
      const double off = i % 3 == 0 ? 0 : .1;
      x[i] = on[i].x() + dice.between(-off, off), y[i] = on[i].y() + dice.between(-off, off);
      z[i] = on[i].z() + dice.between(-off, off);
    }
    std::vector<Vec3> moved = on, facing = on;
    apex.advance_all(moved, 0, .3);
    apex.facing_all(facing);
    apex.places_of(x.data(), y.data(), z.data(), n, theta.data(), a.data());
    const double border = 2.5;
    const std::vector<char> far = apex.are_beyond(x.data(), y.data(), z.data(), n, border);
    for (size_t i = 0; i < n; ++i) {
      const Vec3 p(x[i], y[i], z[i]);
      EXPECT_EQ(moved[i], apex.advance(on[i], 0, .3)) << name;
      EXPECT_EQ(facing[i], apex.facing(on[i])) << name;
      EXPECT_EQ(a[i], apex.arc_of(p)) << name;
      EXPECT_EQ(far[i] != 0, apex.is_beyond(p, border)) << name;
      const double angle = x[i] == 0 && z[i] == 0 ? 0 : std::atan2(z[i], x[i]) * 180 / M_PI;
      EXPECT_NEAR(theta[i], angle, 1e-13 * 180) << name;
    }
  }
}

/// Growth that is even makes tables too, for points one by one and many at once.
TEST(ApexTables, ServeEvenGrowth) {
  for (const Curve& growth : {Curve({{0, .2}, {4, .2}}), Curve({{0, .2}, {20, .2}}), Curve({{0, .25}, {4, .1}}),
                              Curve({{0, .2}, {2, .2}, {8, .2}})}) {
    const Profile profile = Profile::cap(1.45, 1.3, 9);
    const Flow flow(growth);
    ApexTables tables;
    EXPECT_TRUE(tables.ready(profile, flow).view());
    for (const double a : {.1, .5, 1., 3., 6.}) {
      const auto after = tables.after(a, .7);
      ASSERT_TRUE(after) << a;
      EXPECT_NEAR(*after, flow.after(a, .7), 1e-9 * (1 + a));
    }
  }
}

TEST(ApexTables, InstructionSetsGiveTheSameBits) {
  if (!__builtin_cpu_supports("avx2")) GTEST_SKIP() << "only one here";
  Dice dice(10);
  const Profile profile = dome();
  const Flow flow(Curve({{0, .25}, {1.7, .25}, {2, .2}, {2.4, .17}, {8, .17}}));
  ApexTables tables;
  const ApexView* view = tables.ready(profile, flow).view();
  ASSERT_TRUE(view);
  const long n = 4003;
  std::vector<double> xyz(3 * n);
  for (double& value : xyz) value = dice.between(-2, 2);
  const double *x = xyz.data(), *y = x + n, *z = y + n;
  std::vector<double> results[2];
  for (const ApexKernels* kernels : {&sse2::apex_kernels(), &avx2::apex_kernels()}) {
    std::vector<double> moved = xyz, facing = xyz, theta(n), a(n), far(n);
    for (long i = 0; i < n; ++i) {  // on the surface
      const double r = std::hypot(moved[3 * i], moved[3 * i + 2]);
      moved[3 * i + 1] = profile.at(profile.arc_at_radius(std::min(r, 1.3))).y();
    }
    kernels->move(*view, .2, moved.data(), n);
    kernels->face(*view, facing.data(), n);
    kernels->locate(*view, x, y, z, n, theta.data(), a.data());
    kernels->beyond(*view, x, y, z, n, 1.5, far.data());
    std::vector<double>& all = results[kernels == &avx2::apex_kernels()];
    for (const auto& part : {moved, facing, theta, a, far}) all.insert(all.end(), part.begin(), part.end());
  }
  EXPECT_EQ(std::memcmp(results[0].data(), results[1].data(), results[0].size() * sizeof(double)), 0);
}

/// Points by the four and what is left of them: each as alone, and nothing written behind them.
TEST(ApexTables, AnyNumberOfPointsIsAnsweredAsOne) {
  Dice dice(11);
  const Profile profile = dome();
  const Flow flow(Curve({{0, .25}, {1.7, .25}, {2, .2}, {2.4, .17}, {8, .17}}));
  ApexTables tables;
  const ApexView* view = tables.ready(profile, flow).view();
  ASSERT_TRUE(view);
  const Disc discs[] = {{.5, -.2, .5, 1}, {-.5, -.2, .5, 2}, {.4, -.3, .4, 1}};
  std::vector<const ApexKernels*> sets{&sse2::apex_kernels()};
  if (__builtin_cpu_supports("avx2")) sets.push_back(&avx2::apex_kernels());
  // Of points x, y, z, x, y, z, ...: eleven columns of as many values.
  const auto answers = [&](const ApexKernels& kernels, const std::vector<double>& xyz) {
    const size_t n = xyz.size() / 3;
    const long count = static_cast<long>(n);
    std::vector<double> x(n), y(n), z(n), all;
    for (size_t i = 0; i < n; ++i) x[i] = xyz[3 * i], y[i] = xyz[3 * i + 1], z[i] = xyz[3 * i + 2];
    constexpr double untouched = -77;
    const auto keep = [&](const std::vector<double>& column) {
      all.insert(all.end(), column.begin(), column.begin() + count);
      EXPECT_TRUE(std::all_of(column.begin() + count, column.end(), [](double v) { return v == untouched; }));
    };
    const auto keep_points = [&](const std::vector<double>& points) {
      for (size_t axis = 0; axis < 3; ++axis)
        for (size_t i = 0; i < n; ++i) all.push_back(points[3 * i + axis]);
      EXPECT_TRUE(std::all_of(points.begin() + 3 * count, points.end(), [](double v) { return v == untouched; }));
    };
    std::vector<double> points = xyz, a(n + 5, untouched), b = a;
    points.resize(3 * n + 12, untouched);
    std::vector<double> facing = points;
    kernels.move(*view, .2, points.data(), count);
    keep_points(points);
    kernels.face(*view, facing.data(), count);
    keep_points(facing);
    kernels.locate(*view, x.data(), y.data(), z.data(), count, a.data(), b.data());
    keep(a), keep(b);
    kernels.beyond(*view, x.data(), y.data(), z.data(), count, 1.5, a.data());
    keep(a);
    kernels.deepest(discs, 3, x.data(), y.data(), z.data(), count, a.data(), b.data());
    keep(a), keep(b);
    return all;
  };
  std::vector<double> points;
  for (int i = 0; i < 13; ++i) {
    const double turn = dice.between(-3, 3), r = i == 6 ? 0 : dice.between(.1, 1.3);
    points.insert(points.end(), {r * std::cos(turn), profile.at(profile.arc_at_radius(r)).y(), r * std::sin(turn)});
  }
  for (const ApexKernels* set : sets)
    for (size_t n = 0; n <= 13; ++n) {
      const std::vector<double> together = answers(*set, {points.begin(), points.begin() + static_cast<long>(3 * n)});
      for (size_t i = 0; i < n; ++i) {
        const double* p = points.data() + 3 * i;
        const std::vector<double> alone = answers(*sets[0], {p, p + 3});
        for (size_t column = 0; column < alone.size(); ++column)
          EXPECT_EQ(std::memcmp(&together[column * n + i], &alone[column], sizeof(double)), 0) << n << " " << column;
      }
    }
}

/// A point far from the surface may have several nearest places: then the tables must not answer.
TEST(ApexTables, AnswerOnlyWhatIsCertain) {
  Dice dice(8);
  for (const auto& [name, apex] : apices())
    for (int i = 0; i < 2000; ++i) {
      const Vec3 p(dice.between(-3, 3), dice.between(-4, 2), dice.between(-3, 3));
      const Apex::Place place = apex.place_of(p);
      const double least = (p - apex.position(place.theta, place.a)).norm();
      EXPECT_NEAR((p - apex.closest(p)).norm(), least, 1e-9) << name;
    }
}

/// They serve where they are made for, so that a slow answer does not go unnoticed.
TEST(ApexTables, ServeOrdinaryApices) {
  const Profile profile = Profile::cap(1.5, 1.3, 9);
  const Flow flow(Curve({{0, .25}, {1.7, .25}, {2, .2}, {2.4, .17}, {8, .17}}));
  ApexTables tables;
  tables.ready(profile, flow);
  for (const double a : {.05, .5, 2., 5., 8.}) {
    EXPECT_TRUE(tables.after(a, .1).has_value()) << a;
    const Vec2 p = profile.at(a);
    EXPECT_TRUE(tables.nearest(p).has_value()) << a;
    EXPECT_TRUE(tables.nearest(p - Vec2(.05, .05)).has_value()) << a;
  }
}

}  // namespace
}  // namespace tunica
