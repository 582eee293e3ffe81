// SPDX-License-Identifier: MIT
#include "solve/integrator.h"

#include "solve/problems_for_tests.h"

namespace tunica {
namespace {

using Status = Integrator::Status;

/// Every method, adaptive ones with a tolerance; those that can be either, as both.
struct Way {
  std::string method;
  double dt, tolerance;
};

std::vector<Way> ways() {
  std::vector<Way> all;
  for (const MethodInfo& m : methods()) {
    if (m.steps == Stepper::Steps::fixed || m.either) all.push_back({m.name, 0.05, 0});
    if (m.steps != Stepper::Steps::fixed) all.push_back({m.name, Integrator::unlimited, 1e-5});
  }
  return all;
}

std::unique_ptr<Integrator> solve(const Problem& p, const Way& w) { return p.solve(w.method, w.dt, w.tolerance); }

std::string label(const Way& w) { return w.method + (w.tolerance > 0 ? " adaptive" : " fixed"); }

TEST(Integrator, PausesChangeNoBits) {
  const Problem p = activator_inhibitor_problem(12, 4);
  for (const Way& w : ways()) {
    const auto straight = solve(p, w), paused = solve(p, w);
    run(*straight, p, 20);
    for (double t = 0.37; paused->time() < 20; t += 0.37) {
      while (run(*paused, p, 20, t) == Status::paused && paused->time() < t - 1e-9) {
      }
      if (w.tolerance > 0 && t < 20) {
        EXPECT_EQ(paused->time(), t) << label(w);
      }
    }
    EXPECT_EQ(values(*straight), values(*paused)) << label(w);
    EXPECT_EQ(straight->steps(), paused->steps()) << label(w);
  }
}

TEST(Integrator, PausedStatesAreInterpolated) {
  const Problem p = smooth_problem();
  const auto exact = p.solve("rk4", 1.0 / 1024);
  for (const char* method : {"bs32", "dp54", "rkc2"}) {
    const auto solver = p.solve(method, Integrator::unlimited, 1e-6), fine = p.solve("rk4", 1.0 / 1024);
    for (const double t : {0.25, 0.5, 0.75, 1.0, 1.25}) {
      run(*solver, p, 2, t);
      run(*fine, p, t);
      EXPECT_LT(difference(*solver, values(*fine)), 2e-5) << method << " " << t;
    }
  }
}

/// The same state in another process: tissue and integrator from bytes.
std::unique_ptr<Integrator> moved(const Problem& p, const Way& w, Integrator& from) {
  auto other = solve(p, w);
  ByteWriter tissue, kept;
  from.system().tissue().save(tissue);
  from.save(kept);
  ByteReader tissue_in(tissue.bytes()), kept_in(kept.bytes());
  other->system().tissue().load(tissue_in);
  other->load(kept_in);
  EXPECT_TRUE(kept_in.at_end());
  return other;
}

TEST(Integrator, ResumedRunsGiveTheSameBits) {
  const Problem p = activator_inhibitor_problem(12, 4);
  for (const Way& w : ways()) {
    const auto straight = solve(p, w);
    run(*straight, p, 20);
    auto part = solve(p, w);
    for (double t = 1.3; part->time() < 20; t += 1.3) {
      run(*part, p, 20, t);
      if (part->time() < 20) part = moved(p, w, *part);
      if (part->time() < t) t -= 1.3;  // a fixed step before it
    }
    EXPECT_EQ(values(*straight), values(*part)) << label(w);
    EXPECT_EQ(straight->steps(), part->steps()) << label(w);
  }
}

TEST(Integrator, AnInterruptedStepIsTakenAgain) {
  const Problem p = activator_inhibitor_problem(12, 4);
  for (const Way& w : ways()) {
    const auto straight = solve(p, w);
    run(*straight, p, 5);
    auto part = solve(p, w);
    CancelFlag flag;
    int asked = 0;
    while (part->time() < 5) {
      const auto status = part->advance(
          5, {}, [&] { return ++asked % 3 == 0; }, &flag, p.parameters);
      if (status == Status::out_of_time) part = moved(p, w, *part);
    }
    EXPECT_EQ(values(*straight), values(*part)) << label(w);
  }
}

TEST(Integrator, ATissueChangedAtAPauseIsGoneOnFrom) {
  const Problem p = activator_inhibitor_problem(12, 4);
  for (const Way& w : ways()) {
    if (w.tolerance == 0) continue;
    const auto a = solve(p, w), b = solve(p, w);
    run(*a, p, 5, 1.0);
    EXPECT_EQ(a->time(), 1);
    a->system().tissue().column(Kind::cell, "a").values[7] *= 2;
    run(*a, p, 1.5);
    run(*b, p, 1.0);
    b->system().tissue().column(Kind::cell, "a").values[7] *= 2;
    run(*b, p, 1.5);
    EXPECT_LT(difference(*a, values(*b)), 1e-3) << label(w);
  }
}

TEST(Integrator, ATargetWithinTheLastStepIsMet) {
  const Problem p = smooth_problem();
  for (const char* method : {"bs32", "dp54", "rkc2"}) {
    const auto solver = p.solve(method, Integrator::unlimited, 1e-4), fine = p.solve("rk4", 1.0 / 1024);
    run(*solver, p, 2, 1.0);
    EXPECT_EQ(solver->time(), 1) << method;
    EXPECT_EQ(run(*solver, p, 1.0000001), Status::reached);
    EXPECT_EQ(solver->time(), 1.0000001) << method;
    run(*fine, p, 1.0000001);
    EXPECT_LT(difference(*solver, values(*fine)), 2e-3) << method;
  }
}

TEST(Integrator, NotANumberStopsWithinAStep) {
  Problem p;
  Writer w{*p.equations};
  const NodeId u = w.cell("u"), late = p.equations->graph.binary(Op::less, w.k(1), p.equations->graph.time());
  // u' = -u until t = 1; then the square root of a negative number in cell 5
  w.rate("u", w.sub(p.equations->graph.unary(Op::sqrt, w.mul(late, w.cell("bad"))), u));
  p.tissue = std::make_shared<Tissue>(ring(10));
  Column &column = p.tissue->add_column(Kind::cell, {.name = "u"}),
         &bad = p.tissue->add_column(Kind::cell, {.name = "bad"});
  for (Index i = 0; i < 10; ++i) column.values[i] = 1, bad.values[i] = i == 5 ? -1 : 0;
  for (const Way& way : ways()) {
    const auto solver = solve(p, way);
    try {
      run(*solver, p, 3);
      ADD_FAILURE() << label(way) << " went on";
    } catch (const StepFailed& failed) {
      EXPECT_EQ(failed.failure.column, "u") << label(way);
      if (!find_method(way.method).implicit) {
        EXPECT_EQ(failed.failure.id, p.tissue->id(Kind::cell, 5)) << label(way) << failed.what();
        EXPECT_EQ(failed.failure.kind, way.tolerance > 0 ? "step size" : "not finite");
      }
      EXPECT_NEAR(solver->time(), 1, 0.06) << label(way);
    }
    for (const double v : values(*solver)) EXPECT_TRUE(std::isfinite(v)) << label(way);
  }
}

TEST(Integrator, AStepTooLongForTheMethodIsNamed) {
  const Problem p = activator_inhibitor_problem(50, 4);
  for (const double dt : {.05, .0606, .065}) {
    for (const char* method : {"euler", "heun"}) {
      const auto solver = p.solve(method, dt);
      std::string message;
      try {
        run(*solver, p, 200);
      } catch (const StepFailed& failed) {
        message = failed.what();
        EXPECT_NE(failed.failure.kind, "not finite");
      }
      EXPECT_EQ(message.find("this method's limit") != std::string::npos, dt > .062) << method << dt << message;
    }
  }
}

TEST(Integrator, TheLastStepCanBeLookedIntoAndTakenAgain) {
  const Problem p = smooth_problem();
  for (const Way& w : ways()) {
    const auto solver = solve(p, w), fine = p.solve("rk4", 1.0 / 1024);
    run(*solver, p, 2, 0.8);
    run(*solver, p, 2, -1.0);
    const auto last = solver->last_step();
    ASSERT_TRUE(last) << label(w);
    const std::vector<double> end = values(*solver);
    const double middle = last->begin + 0.4 * (last->end - last->begin);
    solver->show(middle);
    EXPECT_EQ(solver->time(), middle);
    const std::vector<double> shown = values(*solver);
    solver->show(last->end);
    EXPECT_EQ(values(*solver), end);
    solver->retake(middle);
    EXPECT_EQ(solver->time(), middle);
    EXPECT_LT(difference(*solver, shown), w.method == "backward_euler" ? 1e-3 : 5e-5) << label(w);
    run(*solver, p, 2);
    run(*fine, p, 2);
    EXPECT_LT(difference(*solver, values(*fine)), solver->stepper().order() == 1 ? 2e-2 : 2e-3) << label(w);
  }
}

}  // namespace
}  // namespace tunica
