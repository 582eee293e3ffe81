// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>

#include "base/bytes.h"
#include "solve/problems.h"

namespace tunica {
namespace {

double order_of(const char* name, double h) {
  GridProblem p(20, 4);
  const auto reference = p.run(*make_stepper("rk4"), 8, 0.0025).y;
  const auto error = [&](double step) {
    return p.error(p.run(*make_stepper(name, {.tolerance = 1e-10}), 8, step).y, reference);
  };
  return std::log2(error(h) / error(h / 2));
}

TEST(Implicit, OrdersAreThoseOfTheMethods) {
  EXPECT_NEAR(order_of("backward_euler", 0.05), 1.0, 0.05);
  EXPECT_NEAR(order_of("crank_nicolson", 0.25), 2.0, 0.05);
  EXPECT_NEAR(order_of("bicg", 0.25), 2.0, 0.1);
}

TEST(Implicit, CrankNicolsonKeepsItsFactors) {
  GridProblem p(50, 4);
  const auto reference = p.run(*make_stepper("rk4"), 150, 0.05).y;
  const auto run = p.run(*make_stepper("crank_nicolson"), 150, 0.5);
  EXPECT_EQ(run.failed, "");
  EXPECT_NEAR(p.error(run.y, reference), 2.7e-4, 0.3e-4);
  EXPECT_EQ(run.steps, 300);
  EXPECT_LE(run.work.factorizations, 4u);
  EXPECT_LE(run.work.newton_iterations, 900u);
}

TEST(Implicit, BiconjugateGradientsTakeWhatTheThesisSays) {
  GridProblem p(50, 100);
  const auto run = p.run(*make_stepper("bicg"), 30, 0.5);
  EXPECT_EQ(run.failed, "");
  const double mean = static_cast<double>(run.work.linear_iterations) / static_cast<double>(run.work.newton_iterations);
  EXPECT_GE(mean, 20);
  EXPECT_LE(mean, 60);
}

TEST(Implicit, BackwardEulerSaysWhereNewtonFindsNothing) {
  GridProblem p(50, 100);
  const auto run = p.run(*make_stepper("backward_euler"), 60, 1.0);
  EXPECT_NE(run.failed.find("newton"), std::string::npos) << run.failed;
}

TEST(Implicit, CvodeTakesFewSteps) {
  GridProblem p(50, 4);
  const auto run = p.run(*make_stepper("bdf", {.tolerance = 1e-6}), 150, 0);
  EXPECT_EQ(run.failed, "");
  EXPECT_GE(run.steps, 90);
  EXPECT_LE(run.steps, 140);
  EXPECT_LE(run.work.evaluations, 180u);
  EXPECT_LE(run.work.jacobians, 5u);
}

TEST(Implicit, ANotANumberStopsEachMethod) {
  for (const char* name : {"backward_euler", "crank_nicolson", "bicg", "bdf"}) {
    GridProblem p(10, 4);
    p.start[7] = NAN;
    const auto run = p.run(*make_stepper(name), 1, 0.1);
    EXPECT_NE(run.failed, "") << name;
    EXPECT_EQ(run.steps, 0) << name;
  }
}

/// Taken on from saved bytes by a new object, the method gives the same bits.
TEST(Implicit, ResumesToTheSameBits) {
  for (const char* name : {"backward_euler", "crank_nicolson", "bicg", "bdf"}) {
    GridProblem p(20, 4);
    struct State {
      double t = 0;
      AlignedBuffer y, next;
    };
    const auto begin = [&](State& s) {
      s.y.resize(p.start.size());
      s.next.resize(p.start.size());
      std::copy(p.start.begin(), p.start.end(), s.y.data());
    };
    const auto go = [&](Stepper& m, State& s, int steps) {
      for (int i = 0; i < steps; ++i) {
        const double h = m.steps() == Stepper::Steps::own ? 50 - s.t : 0.5;
        const StepResult r = m.step(*p.system, s.t, s.y.data(), h, s.next.data());
        ASSERT_EQ(r.failed, nullptr) << name;
        m.accepted();
        s.t += r.taken;
        std::swap(s.y, s.next);
      }
    };
    auto whole = make_stepper(name), first = make_stepper(name), second = make_stepper(name);
    State one, two;
    begin(one);
    begin(two);
    whole->restart(*p.system, 0, one.y.data());
    go(*whole, one, 40);
    first->restart(*p.system, 0, two.y.data());
    go(*first, two, 17);
    ByteWriter out;
    first->save(out);
    first.reset();
    ByteReader in(out.bytes());
    second->load(in);
    go(*second, two, 23);
    EXPECT_EQ(one.t, two.t) << name;
    EXPECT_EQ(std::vector<double>(one.y.data(), one.y.data() + one.y.size()),
              std::vector<double>(two.y.data(), two.y.data() + two.y.size()))
        << name;
  }
}

}  // namespace
}  // namespace tunica
