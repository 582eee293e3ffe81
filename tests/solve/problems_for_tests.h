// SPDX-License-Identifier: MIT
#pragma once

#include <gtest/gtest.h>

#include <cmath>

#include "base/random.h"
#include "rule/equations_for_tests.h"
#include "solve/integrator.h"
#include "tissue/builders.h"

namespace tunica {

/// A model ready to be solved, by any method, from the same start.
struct Problem {
  std::shared_ptr<Equations> equations = std::make_shared<Equations>();
  std::shared_ptr<Tissue> tissue;
  std::vector<double> parameters;
  std::vector<std::string> signed_columns;

  std::unique_ptr<Integrator> solve(const std::string& method, double dt, double tolerance = 0) const {
    auto system = std::make_shared<System>(equations, std::make_shared<Tissue>(copy()));
    const StepperOptions options{.tolerance = tolerance > 0 ? tolerance : 1e-6, .fixed_steps = !(tolerance > 0)};
    auto solver =
        std::make_unique<Integrator>(system, make_stepper(method, options), dt, tolerance > 0 ? tolerance : 1e-6);
    solver->allow_negative(signed_columns);
    return solver;
  }
  Tissue copy() const {
    ByteWriter out;
    tissue->save(out);
    ByteReader in(out.bytes());
    Tissue other = ring(3);
    other.load(in);
    return other;
  }
};

inline Integrator::Status run(Integrator& solver, const Problem& p, double to, std::optional<double> pause = {}) {
  return solver.advance(to, pause, {}, nullptr, p.parameters);
}

inline std::vector<double> values(Integrator& solver) {
  std::vector<double> all;
  for (const System::StateColumn& s : solver.system().state()) {
    const Column& column = solver.system().tissue().column(s.kind, s.name);
    all.insert(all.end(), column.values.data(), column.values.data() + s.count);
  }
  return all;
}

/// The larger over the columns of ||y - ref|| / ||ref||.
inline double difference(Integrator& solver, const std::vector<double>& expected) {
  const std::vector<double> got = values(solver);
  double worst = 0;
  size_t first = 0;
  for (const System::StateColumn& s : solver.system().state()) {
    double error = 0, size = 0;
    for (size_t i = first; i < first + s.count; ++i) {
      error += (got[i] - expected[i]) * (got[i] - expected[i]);
      size += expected[i] * expected[i];
    }
    worst = std::max(worst, std::sqrt(error / size));
    first += s.count;
  }
  return worst;
}

inline double splitmix(uint64_t& state) {
  uint64_t z = (state += 0x9e3779b97f4a7c15ull);
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ull;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebull;
  return static_cast<double>((z ^ (z >> 31)) >> 11) * 0x1p-53;
}

/// Activator-inhibitor (thesis 9.12, 9.13) on a square grid, about its uniform state +- 1 %. Mild: inhibitor_spread 4,
/// spectral radius 32; stiff: 100, 800.
inline Problem activator_inhibitor_problem(int side, double inhibitor_spread) {
  Problem p;
  Writer w{*p.equations};
  const NodeId a = w.cell("a"), h = w.cell("h"), a2 = w.mul(a, a);
  const auto spread = [&](NodeId x) { return w.sum(w.sub(w.across(x), w.own(x))); };
  w.rate("a", w.add(w.sub(w.add(w.div(a2, w.add(w.k(1), h)), w.k(.02)), w.mul(w.k(.2), a)), w.mul(w.k(.2), spread(a))));
  w.rate("h", w.add(w.sub(a2, w.mul(w.k(.32), h)), w.mul(w.P("Dh"), spread(h))));
  p.parameters = {inhibitor_spread};
  p.tissue = std::make_shared<Tissue>(grid(side, side, Wrap::open));
  Column& activator = p.tissue->add_column(Kind::cell, {.name = "a"});
  Column& inhibitor = p.tissue->add_column(Kind::cell, {.name = "h"});
  uint64_t state = 1;
  for (Index i = 0; i < p.tissue->cells(); ++i) {
    activator.values[i] = 1.503012 * (1 + 0.02 * (splitmix(state) - 0.5));
    inhibitor.values[i] = 7.075367 * (1 + 0.02 * (splitmix(state) - 0.5));
  }
  return p;
}

/// A smooth problem whose rates depend on time: du/dt = spread(u) - u^2 / 2 + sin(t) / 2 + 1 on a ring.
inline Problem smooth_problem() {
  Problem p;
  Writer w{*p.equations};
  const NodeId u = w.cell("u");
  w.rate("u", w.add(w.sub(w.sum(w.sub(w.across(u), w.own(u))), w.mul(w.k(.5), w.mul(u, u))),
                    w.add(w.k(1), w.mul(w.k(.5), p.equations->graph.unary(Op::sin, p.equations->graph.time())))));
  p.tissue = std::make_shared<Tissue>(ring(30));
  Column& column = p.tissue->add_column(Kind::cell, {.name = "u"});
  for (Index i = 0; i < 30; ++i) column.values[i] = 1 + 0.5 * std::sin(2 * M_PI * i / 30);
  return p;
}

}  // namespace tunica
