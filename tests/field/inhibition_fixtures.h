// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <numbers>

#include "field/inhibition.h"

namespace tunica {

inline constexpr double degree = std::numbers::pi / 180;

/// A disk with RERG 1 and a cylinder with growth 1; ring of radius R at age 0.
inline InhibitionSettings disk(int samples, double R = 1) {
  InhibitionSettings s;
  s.ring = {R, 0};
  s.track = [R](double age) { return Vec2{R * std::exp(age), 0}; };
  s.displaced = [R](double along) { return Vec2{R + along, 0}; };
  s.samples = samples;
  return s;
}
inline InhibitionSettings cylinder(int samples) {
  InhibitionSettings s;
  s.ring = {1, 0};
  s.track = [](double age) { return Vec2{1, -age}; };
  s.displaced = [](double along) { return Vec2{1, -along}; };
  s.samples = samples;
  return s;
}

/// exp(-b age) / d, and (1 - exp(-c age)) exp(-b age) / d.
inline std::unique_ptr<FieldRule> decaying(double b, double c = 0) {
  Graph g;
  const NodeId d = g.column(Kind::side, 0), age = g.column(Kind::cell, 0);
  const auto decay = [&](double rate) { return g.unary(Op::exp, g.binary(Op::mul, g.constant(-rate), age)); };
  NodeId w = decay(b);
  if (c > 0) w = g.binary(Op::mul, g.binary(Op::sub, g.constant(1), decay(c)), w);
  return std::make_unique<TracedField>(g, g.binary(Op::div, w, d));
}

inline std::function<double(double)> constant(double value) {
  return [value](double) { return value; };
}

inline Inhibition single(InhibitionSettings s, double b, std::function<double(double)> threshold) {
  Inhibition model(std::move(s));
  model.add_field({decaying(b), std::move(threshold)});
  return model;
}

/// Runs until so many have been inserted.
inline void insert(Inhibition& model, size_t count) {
  for (const size_t goal = model.primordia().size() + count; model.primordia().size() < goal;) model.advance(1e300);
}

/// Angle from one primordium to the next in (-180, 180] degrees.
inline double divergence(const Inhibition& model, size_t i) {
  const double turn = (model.primordia()[i].angle - model.primordia()[i - 1].angle) / degree;
  return turn - 360 * std::ceil((turn - 180) / 360);
}

struct Summary {
  double mean, deviation, plastochron;
};
/// Of the last `count` primordia: circular mean, folded to 0..180 degrees.
inline Summary last(const Inhibition& model, size_t count) {
  const auto& p = model.primordia();
  double c = 0, s = 0;
  for (size_t i = p.size() - count; i < p.size(); ++i)
    c += std::cos(divergence(model, i) * degree), s += std::sin(divergence(model, i) * degree);
  const double mean = std::atan2(s, c) / degree;
  double squares = 0;
  for (size_t i = p.size() - count; i < p.size(); ++i) {
    const double off = std::remainder(divergence(model, i) - mean, 360.0);
    squares += off * off;
  }
  return {std::fabs(mean), std::sqrt(squares / static_cast<double>(count)),
          (p.back().birth - p[p.size() - 1 - count].birth) / static_cast<double>(count)};
}

}  // namespace tunica
