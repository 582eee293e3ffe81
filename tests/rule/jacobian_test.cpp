// SPDX-License-Identifier: MIT
#include "rule/jacobian.h"

#include <gtest/gtest.h>

#include <cmath>

#include "rule/complex_step.h"
#include "rule/random_graph.h"
#include "tissue/builders.h"

namespace tunica {
namespace {

/// Largest error of the Jacobian's entries, and of the zeros outside its pattern, against complex steps, relative to
/// the largest entry of the row.
double error_against_complex_steps(System& s, Jacobian& jacobian, const std::vector<double>& parameters, int stride) {
  s.prepare(parameters);
  jacobian.prepare();
  AlignedBuffer y;
  y.resize(s.state_size());
  s.read_state(y.data());
  jacobian.evaluate(0.5, y.data());
  const SparseRows& m = jacobian.matrix();
  ComplexStep reference(s.equations(), s.tissue(), parameters, 0.5);
  double worst = 0;
  for (size_t k = 0; k < s.state().size(); ++k) {
    const System::StateColumn& of = s.state()[k];
    for (Index i = 0; i < of.count; i += stride) {
      if (of.kind == Kind::side && s.tissue().neighbour(i) == none) continue;
      if (of.kind == Kind::wall && s.tissue().wall_side(i, 1) == none) continue;
      const int row = jacobian.offsets()[k] + i;
      std::vector<double> ours(jacobian.size(), 0.0), exact(jacobian.size(), 0.0);
      for (int32_t at = m.begin[row]; at < m.begin[row + 1]; ++at) ours[m.column[at]] = m.value[at];
      double largest = 0;
      for (size_t by = 0; by < s.state().size(); ++by)
        for (Index j = 0; j < s.state()[by].count; ++j) {
          double& x = exact[jacobian.offsets()[by] + j];
          x = reference.derivative(of.column, i, s.state()[by].column, j);
          largest = std::max(largest, std::fabs(x));
        }
      for (int j = 0; j < jacobian.size(); ++j) {
        if (ours[j] == exact[j]) continue;
        const double error = std::fabs(ours[j] - exact[j]) / largest;
        worst = error <= worst ? worst : std::isnan(error) ? INFINITY : error;
      }
    }
  }
  return worst;
}

double error_of(void (*write)(Equations&), std::shared_ptr<Tissue> t, const std::vector<double>& parameters) {
  auto e = std::make_shared<Equations>();
  write(*e);
  System s(e, t);
  Jacobian jacobian(s);
  EXPECT_TRUE(jacobian.missing().empty());
  return error_against_complex_steps(s, jacobian, parameters, 7);
}

std::shared_ptr<Tissue> small_sheet(const std::vector<std::string>& columns, int64_t cells) {
  auto t = std::make_shared<Tissue>(sheet({.cells = cells, .seed = 3}));
  for (const std::string& name : columns) fill(*t, Kind::cell, name, 0.1, 2.0);
  return t;
}

TEST(Jacobian, IsExactForTheModelsOfTheThesis) {
  auto t = std::make_shared<Tissue>(grid(12, 10, Wrap::open));
  fill(*t, Kind::cell, "a", 0.5, 1.5);
  fill(*t, Kind::cell, "h", 0.5, 1.5);
  EXPECT_LT(error_of(activator_inhibitor, t, {.02, .01, .012, .01, .02, .001, .015, .3}), 1e-14);
  EXPECT_LT(error_of(auxin_transport, small_sheet({"auxin", "pin"}, 80), {3, 4, 22.5, 1, 6, 1, .5, .6, .5, 1, 1}),
            1e-13);
  EXPECT_LT(error_of(upwind, small_sheet({"u"}, 80), {2, .5, .1}), 1e-14);
}

TEST(Jacobian, IsExactOnRandomGraphs) {
  auto t = small_sheet({"u", "v"}, 24);
  fill(*t, Kind::side, "s", 0.5, 1.5);
  fill(*t, Kind::side, "z", 0.5, 1.5);
  fill(*t, Kind::wall, "g", 0.5, 1.5);
  int with_second_ring = 0;
  for (uint64_t seed = 0; seed < 500; ++seed) {
    auto e = std::make_shared<Equations>();
    random_equations(*e, seed);
    System s(e, t);
    Jacobian jacobian(s);
    with_second_ring += jacobian.intermediates() > 0;
    EXPECT_LT(error_against_complex_steps(s, jacobian, {0.7, 1.3}, 9), 1e-12)
        << "seed " << seed << ": " << e->graph.text(e->rates[0].value);
  }
  EXPECT_GT(with_second_ring, 50);
}

}  // namespace
}  // namespace tunica
