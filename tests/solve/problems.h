// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <cstring>
#include <map>
#include <vector>

#include "rule/equations_for_tests.h"
#include "rule/system.h"
#include "solve/stepper.h"
#include "tissue/builders.h"

namespace tunica {

/// The activator-inhibitor of thesis 9.12-9.13 on an n x n grid: mild with Dh = 4, stiff with Dh = 100. It starts from
/// the homogeneous state with 1 % of noise (splitmix64, seed 1, in the order a0, h0, a1, h1, ...).
struct GridProblem {
  std::shared_ptr<Tissue> tissue;
  std::shared_ptr<Equations> equations = std::make_shared<Equations>();
  std::unique_ptr<System> system;
  std::vector<double> start;

  GridProblem(int n, double Dh) : tissue(std::make_shared<Tissue>(grid(n, n))) {
    uint64_t state = 1;
    const auto uniform = [&] {
      uint64_t z = (state += 0x9e3779b97f4a7c15ull);
      z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ull;
      z = (z ^ (z >> 27)) * 0x94d049bb133111ebull;
      return static_cast<double>((z ^ (z >> 31)) >> 11) * 0x1.0p-53;
    };
    for (const char* name : {"a", "h"}) tissue->add_column(Kind::cell, {.name = name});
    double* a = tissue->column(Kind::cell, "a").values.data();
    double* h = tissue->column(Kind::cell, "h").values.data();
    for (Index i = 0; i < tissue->cells(); ++i) {
      a[i] = 1.503012 * (1 + 0.01 * (2 * uniform() - 1));
      h[i] = 7.075367 * (1 + 0.01 * (2 * uniform() - 1));
    }
    activator_inhibitor(*equations);
    system = std::make_unique<System>(equations, tissue);
    const std::map<std::string, double> values{{"ra", 1}, {"sa", .02}, {"ma", .2},  {"Da", .2},
                                               {"rh", 1}, {"sh", 0},   {"mh", .32}, {"Dh", Dh}};
    std::vector<double> parameters;
    for (const std::string& name : equations->parameters) parameters.push_back(values.at(name));
    system->prepare(parameters);
    start.resize(system->state_size());
    system->read_state(start.data());
  }

  /// Steps of length h (or the method's own towards `until`) from t = 0; stops at a failure.
  struct Outcome {
    std::vector<double> y;
    int steps = 0;
    std::string failed;
    Work work;
  };
  Outcome run(Stepper& method, double until, double h) {
    Outcome o;
    AlignedBuffer y, next;
    y.resize(start.size());
    next.resize(start.size());
    std::memcpy(y.data(), start.data(), sizeof(double) * start.size());
    method.restart(*system, 0, y.data());
    for (double t = 0; until - t > 1e-9 * until && o.failed.empty();) {
      const double left = until - t;
      const bool own = method.steps() == Stepper::Steps::own;
      const StepResult r = method.step(*system, t, y.data(), own ? left : std::fmin(h, left), next.data());
      if (r.failed) {
        o.failed = std::string(r.failed) + ": " + r.detail;
        break;
      }
      method.accepted();
      t += r.taken;
      ++o.steps;
      std::swap(y, next);
    }
    o.y.assign(y.data(), y.data() + y.size());
    o.work = method.work();
    return o;
  }

  /// Largest over the columns of ||a - b|| / ||b||.
  double error(const std::vector<double>& a, const std::vector<double>& b) const {
    double worst = 0;
    for (const System::StateColumn& c : system->state()) {
      double difference = 0, size = 0;
      for (size_t i = c.offset; i < c.offset + c.count; ++i) {
        difference += (a[i] - b[i]) * (a[i] - b[i]);
        size += b[i] * b[i];
      }
      const double e = std::sqrt(difference / size);
      worst = e <= worst ? worst : e;
    }
    return worst;
  }
};

}  // namespace tunica
