// SPDX-License-Identifier: MIT
// Growth from one cell to 100,000: time per division as the tissue grows, memory per cell, and what stays right.
#include <fmt/format.h>
#include <sys/resource.h>
#include <time.h>

#include <cmath>

#include "shape/plane.h"
#include "tissue/builders.h"
#include "tissue/division.h"
#include "tissue/statistics.h"
#include "tissue/validity.h"

namespace tunica {
namespace {

double cpu_seconds() {
  timespec t;
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

double resident_mib() {
  rusage use;
  getrusage(RUSAGE_SELF, &use);
  return static_cast<double>(use.ru_maxrss) / 1024;
}

int run() {
  const double empty = resident_mib();
  Tissue t = polygon(8, 0.6, 1);
  Column& amount = t.add_column(Kind::cell, {.name = "amount", .initial = 1, .inherit = Inherit::split});
  amount.values[0] = 1;
  t.add_column(Kind::cell, {.name = "auxin", .initial = 1});
  const UniformGrowth growth(1.0);
  const Threshold threshold{.area = 1, .variation = 0.3};
  fmt::print(
      "Growth from one cell by Errera's rule, steps of 1 % in length. us of thread CPU per division while the tissue "
      "doubles,\n"
      "growing and dividing apart; split amounts must add up to 1.\n\n");
  fmt::print("{:>8} {:>10} {:>12} {:>10} {:>14}\n", "cells", "us/division", "us growing", "ratio", "amount error");
  double dividing = 0, growing = 0, first = 0, last = 0;
  int64_t divisions = 0, goal = 500;
  double time = 0;
  while (t.cells() < 100000) {
    double begun = cpu_seconds();
    grow(t, growth, time, 0.01);
    time += 0.01;
    growing += cpu_seconds() - begun;
    begun = cpu_seconds();
    divisions += divide_above(t, threshold, errera);
    dividing += cpu_seconds() - begun;
    if (t.cells() < goal) continue;
    double sum = 0;
    for (Index c = 0; c < t.cells(); ++c) sum += amount.values[c];
    last = (dividing + growing) / static_cast<double>(divisions) * 1e6;
    if (goal == 1000) first = last;
    fmt::print("{:>8} {:>10.2f} {:>12.2f} {:>10} {:>14.1e}\n", t.cells(),
               dividing / static_cast<double>(divisions) * 1e6, growing / static_cast<double>(divisions) * 1e6,
               first > 0 ? fmt::format("{:.2f}", last / first) : "", std::fabs(sum - 1));
    dividing = growing = 0;
    divisions = 0;
    goal *= 2;
  }
  const double cells = t.cells();
  fmt::print("\nratio of the last doubling to the one that ends at 1,000 cells: {:.2f} (bound 1.5)\n", last / first);
  fmt::print("memory: {:.0f} bytes per cell ({} cells with two columns, {:.1f} walls and {:.1f} junctions each)\n",
             (resident_mib() - empty) * 1048576 / cells, t.cells(), t.walls() / cells, t.junctions() / cells);
  validate(t);
  const CellStatistics s = cell_statistics(t);
  fmt::print("every invariant holds; mean sides {:.3f}, junctions where four walls meet {}\n", s.mean_sides,
             s.four_way);
  return 0;
}

}  // namespace
}  // namespace tunica

int main() { return tunica::run(); }
