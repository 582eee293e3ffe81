// SPDX-License-Identifier: MIT
#include "sweep/search.h"

#include <cmath>
#include <pagmo/algorithm.hpp>
#include <pagmo/algorithms/cmaes.hpp>
#include <pagmo/population.hpp>
#include <pagmo/problem.hpp>

#include "base/error.h"
#include "base/random.h"

namespace tunica::sweep {

namespace {

/// pagmo asks for one value after the other. So that a whole generation can be evaluated at once, a copy of the
/// algorithm is let run first, whose questions are noted; then the algorithm itself, whose questions are answered.
struct Exchange {
  bool asking = true;
  std::vector<Point> asked;
  std::vector<double> answers;
  size_t next = 0;
};

struct Questions {
  std::shared_ptr<Exchange> exchange = std::make_shared<Exchange>();
  size_t dimensions = 1;

  pagmo::vector_double fitness(const pagmo::vector_double& x) const {
    if (!exchange->asking) return {exchange->answers.at(exchange->next++)};
    exchange->asked.push_back(x);
    return {0.0};
  }
  std::pair<pagmo::vector_double, pagmo::vector_double> get_bounds() const {
    return {pagmo::vector_double(dimensions, 0.0), pagmo::vector_double(dimensions, 1.0)};
  }
};

/// A coordinate folded into [0,1] like light between two mirrors.
double reflected(double x) {
  x = std::fabs(std::fmod(x, 2.0));
  return x <= 1 ? x : 2 - x;
}

size_t default_population(size_t dimensions) {
  const auto count = static_cast<size_t>(4 + 3 * std::log(static_cast<double>(dimensions)));
  return std::max<size_t>(6, (count + 1) / 2 * 2);
}

}  // namespace

struct Search::Inside {
  std::shared_ptr<Exchange> exchange;
  pagmo::algorithm algorithm;
  pagmo::population population;
};

Search::Search(const Settings& s) {
  if (s.start.empty()) fail("a search needs at least one parameter that varies over a range");
  Questions questions{.dimensions = s.start.size()};
  const size_t count = s.population ? s.population : default_population(s.start.size());
  const auto seed = static_cast<unsigned>(4294967296.0 * uniform({.seed = s.seed, .purpose = purpose("search")}));
  // One generation at a time, with its own strategy parameters; no end by tolerances; memory; no bounds of its own.
  pagmo::algorithm algorithm{pagmo::cmaes(1, -1, -1, -1, -1, s.step, 0, 0, true, false, seed)};
  pagmo::population population{pagmo::problem{questions}, 0, seed};
  for (size_t i = 0; i < count; ++i) population.push_back(s.start, {0.0});  // the first mean is the best of these
  inside_.reset(new Inside{questions.exchange, std::move(algorithm), std::move(population)});
}

Search::~Search() = default;

size_t Search::population() const { return inside_->population.size(); }

std::vector<Point> Search::ask() {
  Exchange& exchange = *inside_->exchange;
  exchange = {.asking = true};
  const pagmo::algorithm copy = inside_->algorithm;
  copy.evolve(inside_->population);
  std::vector<Point> points = exchange.asked;
  for (auto& point : points)
    for (double& x : point) x = reflected(x);
  return points;
}

void Search::tell(const std::vector<double>& values) {
  Exchange& exchange = *inside_->exchange;
  exchange = {.asking = false, .answers = values};
  inside_->population = inside_->algorithm.evolve(inside_->population);
}

}  // namespace tunica::sweep
