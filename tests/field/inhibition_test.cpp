// SPDX-License-Identifier: MIT
#include "field/inhibition.h"

#include <gtest/gtest.h>

#include "field/inhibition_fixtures.h"

namespace tunica {
namespace {

TEST(Inhibition, FieldOfOneOnADiskIsExact) {
  for (const double b : {0.0, 1.0, 7.0}) {
    Inhibition model = single(disk(360), b, constant(1e-9));
    model.add_primordium(0, 0);
    const std::vector<double> h = model.ring_values(0);
    EXPECT_NEAR(h[180], 0.5, 1e-15);
    EXPECT_NEAR(h[90], std::sqrt(0.5), 1e-15);
    EXPECT_GT(h[0], 1e6);
  }
  Inhibition model = single(disk(360), 1, constant(1e-9));
  model.add_primordium(0, 1);
  const double e = std::exp(1.0);
  EXPECT_NEAR(model.ring_values(0)[0], 1 / e / (e - 1), 1e-15);
  EXPECT_NEAR(model.ring_values(0)[180], 1 / e / (e + 1), 1e-15);
  EXPECT_NEAR(model.value(0, std::numbers::pi, {1, 0}), 1 / e / (e + 1), 1e-15);
}

struct Steady {
  double threshold, mean, mean_error, plastochron, plastochron_error;
};

TEST(Inhibition, AnglesAndPlastochronsOnADisk) {
  for (const Steady& c :
       {Steady{5, 137.11, .05, .0871, .0003}, {10, 137.63, .05, .0482, .0002}, {2.5, 139.16, .05, .1527, .0005}}) {
    Inhibition model = single(disk(1440), 1, constant(c.threshold));
    model.add_lattice(30, 137.51 * degree, 1, {});
    insert(model, 240);
    const Summary s = last(model, 120);
    EXPECT_NEAR(s.mean, c.mean, c.mean_error) << c.threshold;
    EXPECT_NEAR(s.plastochron, c.plastochron, c.plastochron_error) << c.threshold;
  }
}

TEST(Inhibition, FirstAnglesWith38Samples) {
  for (uint64_t seed = 1; seed <= 10; ++seed) {
    InhibitionSettings settings = cylinder(38);
    settings.seed = seed;
    Inhibition model =
        single(settings, 3.246, [](double t) { return .1809 + (.7801 - .1809) * std::min(1.0, t / 7.775); });
    model.add_random();
    insert(model, 20);
    const double sign = divergence(model, 2) > 0 ? 1 : -1;
    const int expected[] = {19, 12, 17, 14, 15, 15, 15, 15, 15, 15};
    for (size_t i = 0; i < std::size(expected); ++i) {
      const double turn = divergence(model, i + 1) * 38 / 360;
      EXPECT_NEAR(i == 0 ? std::fabs(turn) : sign * turn, expected[i], 1e-6) << "seed " << seed << ", step " << i;
    }
  }
}

/// A rule that is not traced, in the same form.
class Direct : public FieldRule {
 public:
  void add(double age, double t, const double* d, int count, double* h) override {
    for (int i = 0; i < count; ++i) h[i] += at(d[i], age, t);
  }
  double at(double d, double age, double) override { return std::exp(-age) / d; }
};

/// w / d by the short way, over blocks, and by a rule of the host: the same to rounding, padding or not.
TEST(Inhibition, WaysToComputeAFieldAgree) {
  for (const int samples : {3, 37, 360, 1001}) {
    Graph g;
    const NodeId d = g.column(Kind::side, 0), age = g.column(Kind::cell, 0);
    const NodeId w = g.unary(Op::exp, g.unary(Op::neg, age));
    Inhibition model(disk(samples));
    model.add_field({decaying(1), constant(1)});
    model.add_field({std::make_unique<TracedField>(
                         g, g.binary(Op::mul, w, g.unary(Op::exp, g.unary(Op::neg, g.unary(Op::log, d))))),
                     constant(1)});
    model.add_field({std::make_unique<Direct>(), constant(1)});
    Inhibition alone = single(disk(samples), 1, constant(1));
    for (Inhibition* m : {&model, &alone}) m->add_lattice(30, 2.3, 1, .07);
    const std::vector<double> quotient = alone.ring_values(0);
    for (size_t k = 0; k < 3; ++k) {
      const std::vector<double> h = model.ring_values(k);
      ASSERT_EQ(h.size(), static_cast<size_t>(samples));
      for (size_t s = 0; s < h.size(); ++s) EXPECT_NEAR(h[s], quotient[s], 1e-12 * quotient[s]) << k << ", " << s;
    }
    for (const size_t s : {size_t{0}, quotient.size() - 1})
      EXPECT_NEAR(alone.value(0, alone.angles()[s], {1, 0}), quotient[s], 1e-12 * quotient[s]);
  }
}

/// 1 - exp(-c age) at an age at which the difference would have no digits, and 0 times infinity at age 0.
TEST(Inhibition, YoungPrimordiaKeepTheirDigits) {
  const std::unique_ptr<FieldRule> rule = decaying(1, 2);
  EXPECT_NEAR(rule->at(1, 1e-18, 0), 2e-18, 1e-32);
  EXPECT_EQ(*rule->reciprocal(0, 0), 0);
  Inhibition model(disk(360));
  model.add_field({decaying(1, 2), constant(0)});
  model.add_primordium(0, 0);
  for (const double h : model.ring_values(0)) EXPECT_EQ(h, 0);
  EXPECT_FALSE(model.minimum().candidate);  // 0 is not below 0
}

/// The time of an insertion against one found by bisection from outside.
TEST(Inhibition, TimesAreLocated) {
  for (const double tolerance : {1e-2, 1e-4, 1e-8}) {
    InhibitionSettings settings = disk(180);
    settings.tolerance = tolerance;
    Inhibition model = single(settings, 1, constant(2));
    model.add_primordium(0, 0);
    insert(model, 1);
    // The second comes at once: opposite to the first the field is 1/2.
    EXPECT_EQ(model.primordia()[1].birth, 0);
    insert(model, 40);
    // With the last one taken away, the field there is at the threshold when it came.
    Inhibition again = single(settings, 1, constant(2));
    const auto& list = model.primordia();
    const double born = list.back().birth;
    for (size_t i = 0; i + 1 < list.size(); ++i) again.add_primordium(list[i].angle, born - list[i].birth);
    const double h = again.value(0, list.back().angle, {1, 0});
    EXPECT_LT(h, 2);
    EXPECT_NEAR(h, 2, 2 * tolerance) << tolerance;
  }
}

TEST(Inhibition, LatticeIsAtTheThreshold) {
  for (const double threshold : {.5, 2.0, 5.0, 20.0}) {
    Inhibition model = single(disk(360), 1, constant(threshold));
    EXPECT_GT(model.add_lattice(20, 137.51 * degree, 1, {}), 0);
    EXPECT_NEAR(model.value(0, 0, {1, 0}), threshold, 1e-9 * threshold) << threshold;
  }
  Inhibition never =
      single(cylinder(360), 1, constant(1e9));  // no plastochron gives that: the one of the largest field
  EXPECT_GT(never.add_lattice(2, 137.51 * degree, 1, {}), 0);
  Inhibition given = single(disk(360), 1, constant(1));
  EXPECT_EQ(given.add_lattice(2, 1, 3, .25), .25);
  EXPECT_EQ(given.primordia().size(), 6u);
  EXPECT_EQ(given.primordia()[0].birth, -.5);
}

/// Old primordia that are left out change nothing that is seen.
TEST(Inhibition, LeavingOutIsSafe) {
  std::vector<std::vector<Primordium>> runs;
  size_t active = 0;
  for (const double drop : {0.0, 1e-9}) {
    InhibitionSettings settings = disk(360);
    settings.drop = drop;
    Inhibition model = single(settings, 1, constant(4));
    model.add_lattice(30, 137.51 * degree, 1, {});
    insert(model, 300);
    runs.push_back(model.primordia());
    active = model.primordia().size() - model.first_active();
  }
  EXPECT_LT(active, 150u);
  for (size_t i = 0; i < runs[0].size(); ++i) {
    EXPECT_EQ(runs[0][i].angle, runs[1][i].angle) << i;
    EXPECT_NEAR(runs[0][i].birth, runs[1][i].birth, 1e-7) << i;
  }
  // Without decay on a cylinder nothing is negligible: the number is capped, which is said.
  InhibitionSettings settings = cylinder(36);
  settings.most_active = 50;
  Inhibition model = single(settings, 0, constant(6));
  model.add_random();
  insert(model, 100);
  EXPECT_TRUE(model.overflowed());
  EXPECT_LE(model.primordia().size() - model.first_active(), 70u);
}

std::string state_of(const Inhibition& model) {
  ByteWriter out;
  model.save(out);
  return out.take();
}

/// Saved and loaded anywhere, shown at any time: the same bits follow. With noise, two fields, a threshold that moves.
TEST(Inhibition, CheckpointsAndPausesChangeNoBit) {
  const auto make = [] {
    InhibitionSettings settings = cylinder(90);
    settings.jitter_angle = .01, settings.jitter_along = .003, settings.seed = 7;
    Inhibition model(settings);
    model.add_field({decaying(1, 3), [](double t) { return 2 + std::sin(t); }});
    model.add_field({decaying(6), constant(3)});
    return model;
  };
  Inhibition whole = make();
  whole.add_random();
  while (whole.time() < 9) whole.advance(9);
  EXPECT_GT(whole.primordia().size(), 30u);
  Inhibition paused = make();
  paused.add_random();
  for (int i = 1; i <= 50; ++i) {
    while (paused.time() < 9 * i / 50.0) paused.advance(9 * i / 50.0);
    const std::string saved = state_of(paused);
    paused = make();
    ByteReader in(saved);
    paused.load(in);
    EXPECT_EQ(state_of(paused), saved);
  }
  EXPECT_EQ(state_of(paused), state_of(whole));
  const std::string saved = state_of(whole);
  for (size_t cut = 0; cut < saved.size(); cut += 13) {
    ByteReader in(std::string_view(saved).substr(0, cut));
    EXPECT_THROW(paused.load(in), Error);
  }
  EXPECT_EQ(state_of(paused), saved);
}

TEST(Inhibition, SeedsGiveOtherRuns) {
  std::vector<double> first;
  for (const uint64_t seed : {1u, 2u, 1u}) {
    InhibitionSettings settings = disk(360);
    settings.seed = seed;
    Inhibition model = single(settings, 1, constant(1));
    model.add_random();
    first.push_back(model.primordia()[0].angle);
  }
  EXPECT_EQ(first[0], first[2]);
  EXPECT_NE(first[0], first[1]);
}

TEST(Inhibition, CancelledBetweenConsistentStates) {
  CancelFlag cancel;
  InhibitionSettings settings = disk(360);
  settings.cancel = &cancel;
  Inhibition model = single(settings, 1, constant(3)), whole = single(disk(360), 1, constant(3));
  for (Inhibition* m : {&model, &whole}) m->add_random();
  for (int i = 0; i < 200; ++i) {
    if (i % 7 == 3) {
      cancel.request();
      model.advance(5);
      cancel.clear();
    }
    model.advance(5);
  }
  while (model.time() < 5) model.advance(5);
  while (whole.time() < 5) whole.advance(5);
  EXPECT_EQ(state_of(model), state_of(whole));
}

TEST(Inhibition, WrongSettings) {
  const auto with = [](auto&& change) {
    InhibitionSettings settings = disk(360);
    change(settings);
    return settings;
  };
  EXPECT_THROW(Inhibition(with([](auto& s) { s.samples = 2; })), Error);
  EXPECT_THROW(Inhibition(with([](auto& s) { s.jugacy = 7; })), Error);
  EXPECT_THROW(Inhibition(with([](auto& s) { s.ring = {0, 0}; })), Error);
  EXPECT_THROW(Inhibition(with([](auto& s) { s.track = [](double) { return Vec2{1, 0}; }; })), Error);
  EXPECT_THROW(Inhibition(with([](auto& s) { s.located = false; })), Error);
  EXPECT_THROW(Inhibition(disk(360)).advance(1), Error);
  Inhibition model = single(disk(360), 1, constant(NAN));
  model.add_random();
  EXPECT_THROW(model.advance(1), Error);
  Inhibition endless = single(disk(360), 1, constant(1e300));
  endless.add_random();
  EXPECT_THROW(while (true) endless.advance(1), Error);
}

}  // namespace
}  // namespace tunica
