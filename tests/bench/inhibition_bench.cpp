// SPDX-License-Identifier: MIT
// Inhibition fields: time per pair, and for each way of finding the times of insertions the time per primordium beside
// its errors. Disk with RERG 1, b = 1, from a lattice at 137.51 degrees; errors against 5,760 samples and times found
// to 1e-9.
#include <cstdio>
#include <ctime>

#include "field/inhibition_fixtures.h"

using namespace tunica;

namespace {

double now() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

struct Way {
  const char* name;
  int samples;
  double tolerance;
  double dt;  ///< 0: located; else fixed steps, in plastochrons
};

struct Result {
  Summary summary;
  double seconds, ns_per_pair, evaluations;
};

Result run(const Way& way, double threshold, double plastochron, size_t count) {
  InhibitionSettings settings = disk(way.samples);
  settings.tolerance = way.tolerance;
  settings.located = way.dt == 0;
  settings.longest_step = way.dt * plastochron;
  Inhibition model = single(settings, 1, constant(threshold));
  model.add_lattice(30, 137.51 * degree, 1, {});
  const double begun = now();
  insert(model, count);
  const double seconds = now() - begun;
  const auto n = static_cast<double>(count);
  return {last(model, count / 2), seconds / n, 1e9 * seconds / static_cast<double>(model.pairs()),
          static_cast<double>(model.evaluations()) / n};
}

/// Time per pair of a field that has no quotient by the distance: passes over blocks.
double general_field() {
  Graph g;
  const NodeId d = g.column(Kind::side, 0), age = g.column(Kind::cell, 0);
  const NodeId sum = g.binary(Op::add, d, g.binary(Op::mul, g.constant(2), age));
  Inhibition model(disk(1440));
  model.add_field({std::make_unique<TracedField>(g, g.unary(Op::exp, g.unary(Op::neg, sum))), constant(1e-3)});
  model.add_lattice(100, 137.51 * degree, 1, .1);
  const double begun = now();
  for (int i = 1; i <= 100; ++i) model.advance(1e-6 * i), model.ring_values(0);
  return 1e9 * (now() - begun) / static_cast<double>(model.pairs());
}

}  // namespace

int main() {
  std::printf("exp(-d - 2 age): %.2f ns per pair\n", general_field());
  for (const double threshold : {2.5, 5.0, 10.0}) {
    const Result exact = run({"", 5760, 1e-9, 0}, threshold, 0, 240);
    const double plastochron = exact.summary.plastochron;
    std::printf("\nthreshold %g: %.4f degrees, plastochron %.6f\n", threshold, exact.summary.mean, plastochron);
    std::printf("%-28s %9s %9s %6s %9s %9s %9s\n", "", "us each", "ns/pair", "evals", "angle err", "sd", "T err");
    const Way ways[] = {{"located to 1e-1 T", 1440, 1e-1, 0},     {"located to 1e-2 T", 1440, 1e-2, 0},
                        {"located to 1e-3 T", 1440, 1e-3, 0},     {"located to 1e-6 T", 1440, 1e-6, 0},
                        {"steps of 0.5 T", 1440, 1, .5},          {"steps of 0.1 T", 1440, 1, .1},
                        {"steps of 0.03 T", 1440, 1, .03},        {"steps of 0.01 T", 1440, 1, .01},
                        {"360 samples, to 1e-3 T", 360, 1e-3, 0}, {"90 samples, to 1e-3 T", 90, 1e-3, 0}};
    for (const Way& way : ways) {
      const Result r = run(way, threshold, plastochron, 240);
      std::printf("%-28s %9.0f %9.2f %6.1f %9.3f %9.3f %9.1e\n", way.name, 1e6 * r.seconds, r.ns_per_pair,
                  r.evaluations, std::fabs(r.summary.mean - exact.summary.mean), r.summary.deviation,
                  std::fabs(r.summary.plastochron / plastochron - 1));
    }
  }
}
