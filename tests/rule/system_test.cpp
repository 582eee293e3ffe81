// SPDX-License-Identifier: MIT
#include "rule/system.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/random.h"
#include "rule/equations_for_tests.h"
#include "rule/random_graph.h"
#include "rule/reference.h"
#include "tissue/builders.h"
#include "tissue/order.h"

namespace tunica {
namespace {

std::shared_ptr<Tissue> sheet_with(const std::vector<std::string>& columns, int64_t cells) {
  auto t = std::make_shared<Tissue>(sheet({.cells = cells, .seed = 3}));
  for (const std::string& name : columns) fill(*t, Kind::cell, name, 0.1, 2.0);
  return t;
}

/// Largest error of the rates against the graphs evaluated at every cell, relative to the size of the terms.
double error_against_reference(System& s, const std::vector<double>& parameters) {
  AlignedBuffer y, rates;
  y.resize(s.state_size());
  rates.resize(s.state_size());
  s.read_state(y.data());
  s.rates(0.5, y.data(), rates.data());
  const Reference reference(s.equations(), s.tissue(), parameters, 0.5);
  double worst = 0;
  for (const System::StateColumn& column : s.state()) {
    for (Index i = 0; i < column.count; ++i) {
      Measured sum{0, 0};
      if (column.kind == Kind::side && s.tissue().neighbour(i) == none) continue;
      if (column.kind == Kind::wall && s.tissue().wall_side(i, 1) == none) continue;
      for (const Target& t : s.equations().rates) {
        if (t.column != column.column) continue;
        const Index side = column.kind == Kind::wall ? s.tissue().wall_side(i, 0) : i;
        const Measured m = column.kind == Kind::cell ? reference.at_cell(t.value, i) : reference.at_side(t.value, side);
        sum = {sum.value + m.value, sum.magnitude + m.magnitude};
      }
      const double computed = rates.data()[column.offset + i];
      if (std::isnan(sum.value) && std::isnan(computed)) continue;
      if (sum.value == computed) continue;
      const double error = std::fabs(computed - sum.value) / (sum.magnitude + 1e-300);
      worst = std::isnan(error) ? INFINITY : std::max(worst, error);
    }
  }
  return worst;
}

const std::vector<double> ai{.02, .01, .012, .01, .02, .001, .015, .3};
const std::vector<double> transport{3, 4, 22.5, 1, 6, 1, .5, .6, .5, 1, 1};

TEST(System, ActivatorInhibitorMatchesItsGraph) {
  auto e = std::make_shared<Equations>();
  activator_inhibitor(*e);
  auto t = std::make_shared<Tissue>(grid(40, 30, Wrap::open));
  fill(*t, Kind::cell, "a", 0.5, 1.5);
  fill(*t, Kind::cell, "h", 0.5, 1.5);
  System s(e, t);
  s.prepare(ai);
  EXPECT_LT(error_against_reference(s, ai), 1e-14);
  EXPECT_FALSE(s.plan().uses_edges);
  EXPECT_TRUE(s.plan().row_width.empty());  // two columns are read as they are
}

TEST(System, TransportMatchesItsGraphAndSeparates) {
  auto e = std::make_shared<Equations>();
  auxin_transport(*e);
  auto t = sheet_with({"auxin", "pin"}, 700);
  System s(e, t);
  s.prepare(transport);
  EXPECT_LT(error_against_reference(s, transport), 1e-13);
  EXPECT_FALSE(s.plan().uses_wall_form);
}

TEST(System, UpwindRunsOverWallsAndMatches) {
  auto e = std::make_shared<Equations>();
  upwind(*e);
  auto t = sheet_with({"u"}, 700);
  System s(e, t);
  s.prepare({2, .5, .1});
  EXPECT_TRUE(s.plan().uses_wall_form);
  EXPECT_LT(error_against_reference(s, {2, .5, .1}), 1e-14);
}

TEST(System, RandomGraphsMatchDirectEvaluation) {
  auto t = sheet_with({"u", "v"}, 60);
  fill(*t, Kind::side, "s", 0.5, 1.5);
  fill(*t, Kind::side, "z", 0.5, 1.5);
  fill(*t, Kind::wall, "g", 0.5, 1.5);
  int with_edges = 0;
  for (uint64_t seed = 0; seed < 400; ++seed) {
    auto e = std::make_shared<Equations>();
    random_equations(*e, seed);
    System s(e, t);
    s.prepare({0.7, 1.3});
    with_edges += s.plan().uses_edges;
    // Decisions on rounded values can fall either way; such graphs are rare and show as large errors in single cells.
    EXPECT_LT(error_against_reference(s, {0.7, 1.3}), 1e-9)
        << "seed " << seed << ": " << e->graph.text(e->rates[0].value);
  }
  EXPECT_GT(with_edges, 50);
}

std::vector<double> after_steps(std::shared_ptr<Tissue> t, void (*write)(Equations&),
                                const std::vector<double>& parameters, SystemOptions options, int steps) {
  auto e = std::make_shared<Equations>();
  write(*e);
  System s(e, t, options);
  s.prepare(parameters);
  AlignedBuffer y, next;
  y.resize(s.state_size());
  next.resize(s.state_size());
  s.read_state(y.data());
  for (int i = 0; i < steps; ++i) {
    s.euler(0.01 * i, y.data(), 0.01, next.data());
    std::swap(y, next);
  }
  std::vector<double> by_id(1 << 16, 0.0);
  const System::StateColumn& c = s.state()[0];
  for (Index i = 0; i < c.count; ++i) by_id.at(t->id(Kind::cell, i)) = y.data()[c.offset + i];
  return by_id;
}

TEST(System, SameBitsForInstructionSetsThreadsAndNumbering) {
  struct Case {
    void (*write)(Equations&);
    std::vector<double> parameters;
    std::vector<std::string> columns;
  };
  const Case cases[] = {{auxin_transport, transport, {"auxin", "pin"}}, {upwind, {2, .5, .1}, {"u"}}};
  for (const Case& c : cases) {
    auto t = sheet_with(c.columns, 6000);
    const auto expected = after_steps(t, c.write, c.parameters, {.set = InstructionSet::sse2}, 20);
    if (__builtin_cpu_supports("avx2")) {
      EXPECT_EQ(after_steps(t, c.write, c.parameters, {.set = InstructionSet::avx2}, 20), expected);
    }
    EXPECT_EQ(after_steps(t, c.write, c.parameters, {.threads = 2}, 20), expected);
    auto other = std::make_shared<Tissue>(sheet({.cells = 6000, .seed = 3}));
    for (const std::string& name : c.columns) fill(*other, Kind::cell, name, 0.1, 2.0);
    renumber_along_curve(*other);
    EXPECT_EQ(after_steps(other, c.write, c.parameters, {}, 20), expected);
  }
}

TEST(System, EulerStepIsStatePlusRates) {
  auto e = std::make_shared<Equations>();
  auxin_transport(*e);
  auto t = sheet_with({"auxin", "pin"}, 300);
  System s(e, t);
  s.prepare(transport);
  AlignedBuffer y, rates, next;
  for (AlignedBuffer* b : {&y, &rates, &next}) b->resize(s.state_size());
  s.read_state(y.data());
  s.rates(0, y.data(), rates.data());
  s.euler(0, y.data(), 0.01, next.data());
  for (const auto& c : s.state())
    for (Index i = 0; i < c.count; ++i)
      EXPECT_EQ(next.data()[c.offset + i], y.data()[c.offset + i] + 0.01 * rates.data()[c.offset + i]);
}

TEST(System, NonFiniteAndNegativeResultsAreFlagged) {
  auto e = std::make_shared<Equations>();
  upwind(*e);
  auto t = sheet_with({"u"}, 300);
  System s(e, t);
  s.prepare({2, .5, .1});
  AlignedBuffer y, next;
  y.resize(s.state_size());
  next.resize(s.state_size());
  s.read_state(y.data());
  EXPECT_EQ(s.euler(0, y.data(), 0.001, next.data())[0], 0);
  y.data()[299] = -1;
  EXPECT_EQ(s.euler(0, y.data(), 1e-9, next.data())[0], negative);
  y.data()[299] = NAN;
  EXPECT_TRUE(s.euler(0, y.data(), 0.001, next.data())[0] & not_finite);
}

TEST(Kernels, ExponentialIsAccurateAndKeepsExtremes) {
  for (const InstructionSet set : {InstructionSet::sse2, InstructionSet::best}) {
    const auto& k = kernels(set);
    alignas(64) double x[256], y[256];
    double worst = 0;
    for (int round = 0; round < 400; ++round) {
      for (int i = 0; i < 256; ++i) x[i] = -700 + 1400 * uniform({1, 2, static_cast<uint64_t>(round * 256 + i)});
      if (round % 2)
        for (double& v : x) v /= 300;
      k.elementwise[static_cast<int>(Code::exp)][0]({y, x, x, x, 0, 0, 0, 256});
      for (int i = 0; i < 256; ++i) {
        const long double exact = std::exp(static_cast<long double>(x[i]));
        worst = std::max(worst, static_cast<double>(std::fabs((y[i] - exact) / exact)));
      }
    }
    EXPECT_LT(worst, 3e-16) << k.name;
    const double special[8] = {INFINITY, -INFINITY, NAN, 0.0, 710, -746, 709.7, -708.3};
    for (int i = 0; i < 8; ++i) x[i] = special[i];
    k.elementwise[static_cast<int>(Code::exp)][0]({y, x, x, x, 0, 0, 0, 8});
    EXPECT_EQ(y[0], INFINITY);
    EXPECT_EQ(y[1], 0);
    EXPECT_TRUE(std::isnan(y[2]));
    EXPECT_EQ(y[3], 1);
    EXPECT_EQ(y[4], INFINITY);
    EXPECT_EQ(y[5], 0);
    EXPECT_NEAR(y[6] / std::exp(709.7), 1, 1e-15);
    EXPECT_NEAR(y[7] / std::exp(-708.3), 1, 1e-15);
  }
}

}  // namespace
}  // namespace tunica
