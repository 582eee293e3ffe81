// SPDX-License-Identifier: MIT
#include "solve/steady.h"

#include <gtest/gtest.h>

#include <cmath>

#include "solve/problems.h"
#include "tissue/topology.h"

namespace tunica {
namespace {

/// Made in the first cell, spreading and decaying (thesis 9.5-9.7): a line of n cells.
struct GradientLine {
  std::shared_ptr<Tissue> tissue;
  std::shared_ptr<Equations> equations = std::make_shared<Equations>();
  std::unique_ptr<System> system;
  AlignedBuffer y;
  GradientLine(std::shared_ptr<Tissue> t, double rho, double D, double mu) : tissue(std::move(t)) {
    tissue->add_column(Kind::cell, {.name = "c"});
    tissue->add_column(Kind::cell, {.name = "source"}).values[0] = rho;
    Writer w{*equations};
    const NodeId c = w.cell("c");
    w.rate("c", w.sub(w.cell("source"), w.mul(w.P("mu"), c)));
    w.rate("c", w.mul(w.P("D"), w.sum(w.sub(w.across(c), w.own(c)))));
    system = std::make_unique<System>(equations, tissue);
    std::vector<double> values;
    for (const std::string& name : equations->parameters) values.push_back(name == "D" ? D : mu);
    system->prepare(values);
    y.resize(system->state_size());
  }
};

/// The exact discrete solution (thesis 9.8-9.11 in closed form): c_i = C (r^i + r^(2n+1-i)).
long double exact(int i, int n, long double rho, long double D, long double mu) {
  const long double q = mu / (2 * D), root = std::sqrt(q * (2 + q));
  const long double log_r = std::log1p(q - root);
  const long double C = rho / (D * (root - q) * -std::expm1(2 * n * log_r));
  return C * (std::exp(i * log_r) + std::exp((2 * n + 1 - i) * log_r));
}

TEST(Steady, LineKeepsAllDigits) {
  const int n = 100000;
  const double length = n / 5.0, mu = 1 / (length * length);
  GradientLine p(std::make_shared<Tissue>(line(n)), 1, 1, mu);
  const Steady found = find_steady(*p.system, 0, p.y.data());
  EXPECT_EQ(found.how, "elimination");
  EXPECT_TRUE(found.stable);
  EXPECT_NEAR(found.growth, -mu, 1e-12 * mu);
  double worst = 0;
  for (int i = 1; i <= n; ++i) {
    // log r itself is known to about 1e-19 / r's distance from 1, which bounds what can be asked of the closed form.
    const long double c = exact(i, n, 1, 1, mu);
    worst = std::max(worst, static_cast<double>(std::fabs((p.y.data()[i - 1] - c) / c)));
  }
  EXPECT_LT(worst, 2e-12);
}

TEST(Steady, ALineWhoseCellsAreNumberedOtherwiseIsTheSameLine) {
  const int n = 37;
  GradientLine row(std::make_shared<Tissue>(line(n)), 1, 1, 0.01);
  find_steady(*row.system, 0, row.y.data());
  // Joined anew as 0, 5, 10, ...: neighbours in number are not neighbours in place.
  auto shuffled = std::make_shared<Tissue>(line(1));
  while (shuffled->cells() < n) add_cell(*shuffled);
  const auto at = [&](int i) { return i * 5 % n; };
  for (int i = 0; i + 1 < n; ++i) join(*shuffled, at(i), at(i + 1));
  GradientLine other(shuffled, 1, 1, 0.01);
  EXPECT_EQ(find_steady(*other.system, 0, other.y.data()).how, "elimination");
  for (int i = 0; i < n; ++i) EXPECT_NEAR(other.y.data()[at(i)], row.y.data()[i], 1e-14 * row.y.data()[i]);
}

TEST(Steady, LinearRulesOnAGridAreSolvedDirectly) {
  GradientLine p(std::make_shared<Tissue>(grid(20, 30)), 2, 1, 0.05);
  const Steady found = find_steady(*p.system, 0, p.y.data());
  EXPECT_EQ(found.how, "sparse factors");
  EXPECT_LT(found.residual, 1e-14);
  EXPECT_NEAR(found.growth, -0.05, 1e-8);  // the even mode decays slowest
  double total = 0;
  for (Index c = 0; c < p.tissue->cells(); ++c) total += p.y.data()[c];
  EXPECT_NEAR(total, 2 / 0.05, 1e-9);  // made = decayed
}

TEST(Steady, WhereNothingDecaysItSaysSo) {
  for (const bool on_line : {true, false}) {
    GradientLine p(std::make_shared<Tissue>(on_line ? line(50) : grid(6, 7)), 1, 1, 0);
    try {
      find_steady(*p.system, 0, p.y.data());
      FAIL();
    } catch (const Error& e) {
      EXPECT_NE(std::string(e.what()).find("not determined"), std::string::npos) << e.what();
    }
  }
}

TEST(Steady, HomogeneousStateOfTheActivatorInhibitorIsFoundAndUnstable) {
  GridProblem p(12, 4);
  AlignedBuffer y;
  y.resize(p.start.size());
  for (const System::StateColumn& c : p.system->state())
    for (Index i = 0; i < c.count; ++i) y.data()[c.offset + i] = c.name == "a" ? 1.45 : 7.2;
  const Steady found = find_steady(*p.system, 0, y.data());
  EXPECT_EQ(found.how, "newton");
  EXPECT_LT(found.residual, 1e-10);
  EXPECT_NEAR(y.data()[p.system->state()[0].offset + 5], 1.50101377, 1e-8);
  EXPECT_NEAR(y.data()[p.system->state()[1].offset + 5], 7.04075728, 1e-8);
  EXPECT_TRUE(found.stability_known);
  EXPECT_FALSE(found.stable);
  EXPECT_GT(found.growth, 0);
}

TEST(Steady, ThePatternIsFoundAndStable) {
  GridProblem p(20, 4);
  AlignedBuffer y;
  const auto run = p.run(*make_stepper("rk4"), 2000, 0.08);
  y.resize(run.y.size());
  std::copy(run.y.begin(), run.y.end(), y.data());
  const Steady found = find_steady(*p.system, 0, y.data());
  EXPECT_LT(found.residual, 1e-10);
  EXPECT_TRUE(found.stability_known);
  EXPECT_TRUE(found.stable) << found.growth;
  EXPECT_LT(p.error(std::vector<double>(y.data(), y.data() + y.size()), run.y), 0.05);  // the same pattern
}

}  // namespace
}  // namespace tunica
