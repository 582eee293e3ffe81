// SPDX-License-Identifier: MIT
// Traced rules against C++ loops written by hand for one model each: time as a ratio within one run, and the error
// beside it.
#include <fmt/format.h>
#include <time.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "base/random.h"
#include "rule/equations_for_tests.h"
#include "rule/system.h"
#include "tissue/builders.h"
#include "tissue/order.h"

namespace tunica {
namespace {

double cpu_seconds() {
  timespec t;
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

/// The tissue as a modeller would write it in C++: neighbours of each cell in one array.
struct Graph_ {
  std::vector<int> begin, to, wall;
  std::vector<double> length, area;
  explicit Graph_(const Tissue& t) {
    for (Index c = 0; c < t.cells(); ++c) {
      begin.push_back(static_cast<int>(to.size()));
      Index s = t.first_side(c);
      do {
        if (t.neighbour(s) != none) {
          to.push_back(t.neighbour(s));
          wall.push_back(t.wall_of(s));
          length.push_back(t.has_geometry() ? t.length(t.wall_of(s)) : 1.0);
        }
        s = t.next(s);
      } while (s != t.first_side(c));
      area.push_back(t.has_geometry() ? t.area(c) : 1.0);
    }
    begin.push_back(static_cast<int>(to.size()));
  }
  int cells() const { return static_cast<int>(area.size()); }
};

using State = std::vector<std::vector<double>>;
constexpr double dt = 0.01;

void step_activator_inhibitor(const Graph_& g, State& s, State& next) {
  constexpr double ra = .02, sa = .01, ma = .012, Da = .01, rh = .02, sh = .001, mh = .015, Dh = .3;
  const double *a = s[0].data(), *h = s[1].data();
  for (int i = 0; i < g.cells(); ++i) {
    double spread_a = 0, spread_h = 0;
    for (int k = g.begin[i]; k < g.begin[i + 1]; ++k) {
      spread_a += a[g.to[k]] - a[i];
      spread_h += h[g.to[k]] - h[i];
    }
    next[0][i] = a[i] + dt * (ra * a[i] * a[i] / (1 + h[i]) + sa - ma * a[i] + Da * spread_a);
    next[1][i] = h[i] + dt * (rh * a[i] * a[i] + sh - mh * h[i] + Dh * spread_h);
  }
}

void step_transport(const Graph_& g, State& s, State& next) {
  constexpr double b = 3, D = 4, T = 22.5, kT = 1, rho = 6, kI = 1, mu = .5, rP0 = .6, rP = .5, kP = 1, mP = 1;
  static std::vector<double> power, share;
  power.resize(g.area.size());
  share.resize(g.area.size());
  const double *A = s[0].data(), *p = s[1].data();
  const double log_b = std::log(b);
  for (int i = 0; i < g.cells(); ++i) power[i] = std::exp(log_b * A[i]);
  for (int i = 0; i < g.cells(); ++i) {
    double sum = 0;
    for (int k = g.begin[i]; k < g.begin[i + 1]; ++k) sum += g.length[k] * power[g.to[k]];
    share[i] = p[i] / sum;
  }
  for (int i = 0; i < g.cells(); ++i) {
    const double x = A[i];
    double flux = 0;
    for (int k = g.begin[i]; k < g.begin[i + 1]; ++k) {
      const int j = g.to[k];
      const double y = A[j];
      flux += g.length[k] * (D * (y - x) + T * (share[j] * power[i] * y * y / (1 + kT * x * x) -
                                                share[i] * power[j] * x * x / (1 + kT * y * y)));
    }
    next[0][i] = x + dt * (rho / (1 + kI * x) - mu * x + flux / g.area[i]);
    next[1][i] = p[i] + dt * ((rP0 + rP * x) / (1 + kP * p[i]) - mP * p[i]);
  }
}

void step_upwind(const Graph_& g, State& s, State& next) {
  constexpr double T = 2, rho = .5, mu = .1;
  const double* u = s[0].data();
  for (int i = 0; i < g.cells(); ++i) {
    const double x = u[i];
    double flux = 0;
    for (int k = g.begin[i]; k < g.begin[i + 1]; ++k) {
      const double y = u[g.to[k]];
      flux += g.length[k] * T * (x * std::max(y - x, 0.0) - y * std::max(x - y, 0.0));
    }
    next[0][i] = x + dt * (rho - mu * x - flux / g.area[i]);
  }
}

struct Model {
  const char* name;
  void (*write)(Equations&);
  std::vector<std::pair<std::string, double>> parameters;
  std::vector<std::string> columns;
  void (*step)(const Graph_&, State&, State&);
  double bound;
};

void measure(const Model& model, const char* mesh, std::shared_ptr<Tissue> t, int threads) {
  for (const std::string& name : model.columns) {
    if (t->find_column(Kind::cell, name)) continue;
    Column& c = t->add_column(Kind::cell, {.name = name});
    for (Index i = 0; i < t->cells(); ++i) c.values[i] = 0.5 + uniform({7, purpose(name), t->id(Kind::cell, i)});
  }
  auto e = std::make_shared<Equations>();
  model.write(*e);
  System s(e, t, {.threads = threads});
  std::vector<double> values;
  for (const std::string& name : e->parameters)
    values.push_back(std::find_if(model.parameters.begin(), model.parameters.end(), [&](const auto& p) {
                       return p.first == name;
                     })->second);
  s.prepare(values);
  const Graph_ g(*t);
  State x, next;
  for (const std::string& name : model.columns) {
    const double* v = t->column(Kind::cell, name).values.data();
    x.emplace_back(v, v + t->cells());
  }
  next = x;
  AlignedBuffer y, y_new;
  y.resize(s.state_size());
  y_new.resize(s.state_size());
  s.read_state(y.data());
  const auto ours = [&] {
    s.euler(0, y.data(), dt, y_new.data());
    std::swap(y, y_new);
  };
  const auto by_hand = [&] {
    model.step(g, x, next);
    std::swap(x, next);
  };
  double error = 0;
  for (int i = 0; i < 20; ++i) ours(), by_hand();
  for (const auto& c : s.state()) {
    const size_t k =
        static_cast<size_t>(std::find(model.columns.begin(), model.columns.end(), c.name) - model.columns.begin());
    for (Index i = 0; i < c.count; ++i)
      error = std::max(error, std::fabs(y.data()[c.offset + i] - x[k][i]) / std::fabs(x[k][i]));
  }
  // Both in turn, so that a change of the machine's speed meets both; the least of many batches of about 8 ms.
  const int batch = std::max(1, 800000 / t->cells());
  double best[2] = {1e300, 1e300};
  std::vector<double> ratios;
  for (int round = 0; round < 40; ++round) {
    double spent[2];
    for (const int which : {0, 1}) {
      const double begun = cpu_seconds();
      for (int i = 0; i < batch; ++i) which == 0 ? ours() : by_hand();
      spent[which] = (cpu_seconds() - begun) / batch / t->cells() * 1e9;
      best[which] = std::min(best[which], spent[which]);
    }
    ratios.push_back(spent[0] / spent[1]);
  }
  std::sort(ratios.begin(), ratios.end());
  fmt::print("{:22} {:>10} {:>8} {:>9.2f} {:>9.2f} {:>8.2f} {:>8.2f}   {:>6} {:>10.1e}\n", model.name, mesh, t->cells(),
             best[0], best[1], best[0] / best[1], ratios[ratios.size() / 2], model.bound, error);
}

int run() {
  const Model ai{
      "activator-inhibitor",
      activator_inhibitor,
      {{"ra", .02}, {"sa", .01}, {"ma", .012}, {"Da", .01}, {"rh", .02}, {"sh", .001}, {"mh", .015}, {"Dh", .3}},
      {"a", "h"},
      step_activator_inhibitor,
      1.0};
  const Model transport{"auxin transport",
                        auxin_transport,
                        {{"b", 3},
                         {"D", 4},
                         {"T", 22.5},
                         {"kT", 1},
                         {"rho", 6},
                         {"kI", 1},
                         {"mu", .5},
                         {"rP0", .6},
                         {"rP", .5},
                         {"kP", 1},
                         {"mP", 1}},
                        {"auxin", "pin"},
                        step_transport,
                        0.65};
  const Model up{"upwind (not separable)", upwind, {{"T", 2}, {"rho", .5}, {"mu", .1}}, {"u"}, step_upwind, 1.0};
  fmt::print(
      "Traced rules against C++ loops by hand (-O3). ns of thread CPU per cell and Euler step: least of 40 batches in "
      "turn; ratio of these,\n"
      "median of the ratios batch by batch, the bound set for it, and the largest relative error after 20 steps. "
      "{}\n\n",
      kernels().name);
  fmt::print("{:22} {:>10} {:>8} {:>9} {:>9} {:>8} {:>8}   {:>6} {:>10}\n", "model", "tissue", "cells", "rule",
             "by hand", "ratio", "median", "bound", "error");
  measure(ai, "grid", std::make_shared<Tissue>(grid(50, 50)), 1);
  measure(ai, "grid", std::make_shared<Tissue>(grid(500, 500)), 1);
  for (const int64_t cells : {2000, 50000}) {
    auto t = std::make_shared<Tissue>(sheet({.cells = cells, .seed = 1}));
    renumber_along_curve(*t);
    measure(transport, "sheet", t, 1);
    measure(up, "sheet", t, 1);
  }
  return 0;
}

}  // namespace
}  // namespace tunica

int main() { return tunica::run(); }
