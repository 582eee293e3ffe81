// SPDX-License-Identifier: MIT
#include "rule/system.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/random.h"
#include "rule/equations_for_tests.h"
#include "rule/reference.h"
#include "tissue/builders.h"
#include "tissue/order.h"

namespace tunica {
namespace {

void fill(Tissue& t, Kind kind, const std::string& name, double low, double high) {
  Column& c = t.add_column(kind, {.name = name});
  for (Index i = 0; i < t.count(kind); ++i)
    c.values[i] = low + (high - low) * uniform({7, purpose(name), t.id(kind, i), static_cast<uint32_t>(kind)});
}

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

// A random side or cell expression over all kinds of columns and operations.
struct RandomGraph {
  Writer w;
  uint64_t seed;
  uint64_t draws = 0;
  double u() { return uniform({seed, purpose("graph"), draws++}); }
  int pick(int n) { return static_cast<int>(u() * n); }

  NodeId scalar() { return pick(2) ? w.k(0.2 + u()) : w.P(pick(2) ? "p" : "q"); }
  NodeId cell(int depth) {
    if (depth <= 0 || pick(5) == 0)
      return pick(4) == 0 ? scalar() : pick(6) == 0 ? w.cell("area") : w.cell(pick(2) ? "u" : "v");
    if (pick(4) == 0) {
      static constexpr Op sums[] = {Op::sum, Op::sum, Op::sum, Op::minimum, Op::maximum};
      return w.e.graph.reduce(sums[pick(5)], side(depth - 1));
    }
    return combine(cell(depth - 1), pick(3) ? cell(depth - 1) : scalar());
  }
  NodeId side(int depth) {
    if (depth <= 0 || pick(6) == 0) {
      switch (pick(5)) {
        case 0:
          return w.wall("length");
        case 1:
          return w.side("s");
        case 2:
          return w.e.graph.mirrored(w.side("s"));
        case 3:
          return w.own(cell(depth - 2));
        default:
          return w.across(cell(depth - 2));
      }
    }
    if (pick(5) == 0) {
      const NodeId x = cell(depth - 2);
      if (w.e.graph[x].domain == Domain::cell) return w.sub(w.across(x), w.own(x));
    }
    return combine(side(depth - 1), side(depth - 1));
  }
  NodeId combine(NodeId a, NodeId b) {
    Graph& g = w.e.graph;
    switch (pick(14)) {
      case 0:
      case 1:
      case 2:
        return g.binary(Op::add, a, b);
      case 3:
      case 4:
        return g.binary(Op::sub, a, b);
      case 5:
      case 6:
      case 7:
        return g.binary(Op::mul, a, b);
      case 8:
        return g.binary(Op::div, a, g.binary(Op::add, w.k(1), g.unary(Op::abs, b)));
      case 9:
        return g.unary(pick(2) ? Op::tanh : Op::sin, a);
      case 10:
        return g.unary(Op::exp, g.unary(Op::neg, g.unary(Op::abs, a)));
      case 11:
        return g.binary(pick(2) ? Op::min : Op::max, a, b);
      case 12:
        return g.select(g.binary(Op::less, a, b), a, b);
      default:
        return g.binary(Op::pow, g.unary(Op::abs, a), w.k(1.5));
    }
  }
};

TEST(System, RandomGraphsMatchDirectEvaluation) {
  auto t = sheet_with({"u", "v"}, 60);
  fill(*t, Kind::side, "s", 0.5, 1.5);
  fill(*t, Kind::side, "z", 0.5, 1.5);
  fill(*t, Kind::wall, "g", 0.5, 1.5);
  int with_edges = 0;
  for (uint64_t seed = 0; seed < 400; ++seed) {
    auto e = std::make_shared<Equations>();
    RandomGraph random{{*e}, seed};
    random.w.P("p"), random.w.P("q");
    random.w.rate("u", random.cell(4));
    random.w.rate("v", random.cell(3));
    const auto in_side = [&](NodeId x) { return e->graph[x].domain == Domain::cell ? e->graph.own(x) : x; };
    if (seed % 3 == 0) e->rates.push_back({e->column_slot(Kind::side, "z"), in_side(random.side(3)), ""});
    if (seed % 4 == 0) e->rates.push_back({e->column_slot(Kind::wall, "g"), in_side(random.side(3)), ""});
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
