// SPDX-License-Identifier: MIT
// Exact Jacobians of traced rules: time per cell beside finite differences of a rate function written by hand in C++
// (one evaluation per colour), and the error of each.
#include <fmt/format.h>
#include <time.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "base/random.h"
#include "rule/equations_for_tests.h"
#include "rule/jacobian.h"
#include "tissue/builders.h"
#include "tissue/order.h"

namespace tunica {
namespace {

double cpu_seconds() {
  timespec t;
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

/// Least time of one call, over batches of some milliseconds.
template <class Work>
double least_seconds(Work work) {
  double best = 1e300;
  for (int round = 0; round < 30; ++round) {
    int calls = 0;
    const double begun = cpu_seconds();
    double spent = 0;
    do work(), ++calls;
    while ((spent = cpu_seconds() - begun) < 5e-3);
    best = std::min(best, spent / calls);
  }
  return best;
}

struct Neighbours {
  std::vector<int> begin{0}, to;
  explicit Neighbours(const Tissue& t) {
    for (Index c = 0; c < t.cells(); ++c) {
      Index s = t.first_side(c);
      do {
        if (t.neighbour(s) != none) to.push_back(t.neighbour(s));
        s = t.next(s);
      } while (s != t.first_side(c));
      begin.push_back(static_cast<int>(to.size()));
    }
  }
};

const std::map<std::string, double> mild{{"ra", 1}, {"sa", .02}, {"ma", .2},  {"Da", .2},
                                         {"rh", 1}, {"sh", 0},   {"mh", .32}, {"Dh", 4}};
const std::map<std::string, double> thesis_5_7{{"b", 3},   {"D", 4},    {"T", 22.5}, {"kT", 1}, {"rho", 6}, {"kI", 1},
                                               {"mu", .5}, {"rP0", .6}, {"rP", .5},  {"kP", 1}, {"mP", 1}};

void rates_by_hand(const Neighbours& g, const double* y, double* dydt, int n) {
  const double *a = y, *h = y + n;
  for (int i = 0; i < n; ++i) {
    double spread_a = 0, spread_h = 0;
    for (int k = g.begin[i]; k < g.begin[i + 1]; ++k) spread_a += a[g.to[k]] - a[i], spread_h += h[g.to[k]] - h[i];
    dydt[i] = a[i] * a[i] / (1 + h[i]) + .02 - .2 * a[i] + .2 * spread_a;
    dydt[n + i] = a[i] * a[i] - .32 * h[i] + 4. * spread_h;
  }
}

/// Greedy colours of the columns so that no row sees a colour twice.
std::vector<int> colours(const SparseRows& m, int& count) {
  std::vector<std::vector<int>> rows_of(m.rows());
  for (int i = 0; i < m.rows(); ++i)
    for (int k = m.begin[i]; k < m.begin[i + 1]; ++k) rows_of[m.column[k]].push_back(i);
  std::vector<int> colour(m.rows(), -1);
  count = 0;
  for (int j = 0; j < m.rows(); ++j) {
    std::vector<bool> taken(static_cast<size_t>(count) + 1, false);
    for (const int i : rows_of[j])
      for (int k = m.begin[i]; k < m.begin[i + 1]; ++k)
        if (colour[m.column[k]] >= 0) taken[colour[m.column[k]]] = true;
    colour[j] = static_cast<int>(std::find(taken.begin(), taken.end(), false) - taken.begin());
    count = std::max(count, colour[j] + 1);
  }
  return colour;
}

struct Prepared {
  std::shared_ptr<Tissue> tissue;
  std::shared_ptr<Equations> equations = std::make_shared<Equations>();
  std::unique_ptr<System> system;
  std::unique_ptr<Jacobian> jacobian;
  AlignedBuffer y;
  Prepared(std::shared_ptr<Tissue> t, void (*write)(Equations&), const std::vector<std::string>& columns,
           const std::map<std::string, double>& values)
      : tissue(std::move(t)) {
    for (const std::string& name : columns) {
      Column& c = tissue->add_column(Kind::cell, {.name = name});
      for (Index i = 0; i < tissue->cells(); ++i)
        c.values[i] = 0.5 + uniform({7, purpose(name), tissue->id(Kind::cell, i)});
    }
    write(*equations);
    system = std::make_unique<System>(equations, tissue);
    jacobian = std::make_unique<Jacobian>(*system);
    std::vector<double> ordered;
    for (const std::string& name : equations->parameters) ordered.push_back(values.at(name));
    system->prepare(ordered);
    jacobian->prepare();
    y.resize(system->state_size());
    system->read_state(y.data());
    jacobian->evaluate(0, y.data());
  }
  double nanoseconds() {
    return least_seconds([&] { jacobian->evaluate(0, y.data()); }) / tissue->cells() * 1e9;
  }
};

void activator_inhibitor_on(int side) {
  Prepared p(std::make_shared<Tissue>(grid(side, side)), activator_inhibitor, {"a", "h"}, mild);
  const int n = p.tissue->cells();
  const Neighbours g(*p.tissue);
  SparseRows differences = p.jacobian->matrix();
  int count = 0;
  const std::vector<int> colour = colours(differences, count);
  std::vector<double> y(2 * n), base(2 * n), moved(2 * n), changed(2 * n);
  p.jacobian->gather(p.y.data(), y.data());
  struct Entry {
    int row, place;
  };
  std::vector<std::vector<Entry>> entries(count);
  for (int i = 0; i < 2 * n; ++i)
    for (int k = differences.begin[i]; k < differences.begin[i + 1]; ++k)
      entries[colour[differences.column[k]]].push_back({i, k});
  const auto by_differences = [&] {
    rates_by_hand(g, y.data(), base.data(), n);
    for (int c = 0; c < count; ++c) {
      for (int j = 0; j < 2 * n; ++j) moved[j] = y[j] + (colour[j] == c ? 1.5e-8 : 0.0);
      rates_by_hand(g, moved.data(), changed.data(), n);
      for (const Entry& e : entries[c]) differences.value[e.place] = (changed[e.row] - base[e.row]) / 1.5e-8;
    }
  };
  by_differences();
  double error = 0, largest = 0;
  for (size_t k = 0; k < differences.value.size(); ++k) {
    largest = std::max(largest, std::fabs(differences.value[k]));
    error = std::max(error, std::fabs(differences.value[k] - p.jacobian->matrix().value[k]));
  }
  const double ours = p.nanoseconds(), theirs = least_seconds(by_differences) / n * 1e9;
  fmt::print("{:22} {:>8} {:>10.2f} {:>14.2f} ({:2} colours) {:>8.1f} {:>14.1e}\n", "activator-inhibitor", n, ours,
             theirs, count, theirs / ours, error / largest);
}

void transport_on(int64_t cells) {
  auto t = std::make_shared<Tissue>(sheet({.cells = cells, .seed = 1}));
  renumber_along_curve(*t);
  Prepared p(t, auxin_transport, {"auxin", "pin"}, thesis_5_7);
  fmt::print("{:22} {:>8} {:>10.2f}   {:.1f} entries a row, second ring included\n", "auxin transport", t->cells(),
             p.nanoseconds(), static_cast<double>(p.jacobian->matrix().value.size()) / p.jacobian->size());
}

int run() {
  fmt::print(
      "Exact Jacobians of traced rules, filled into a sparse matrix. ns of thread CPU per cell, least of 30 "
      "batches.\n\n");
  fmt::print("{:22} {:>8} {:>10} {:>26} {:>9} {:>14}\n", "model", "cells", "exact", "differences in C++", "ratio",
             "their error");
  activator_inhibitor_on(50);
  activator_inhibitor_on(200);
  for (const int64_t cells : {2000, 50000}) transport_on(cells);
  return 0;
}

}  // namespace
}  // namespace tunica

int main() { return tunica::run(); }
