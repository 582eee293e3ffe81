// SPDX-License-Identifier: MIT
#pragma once

#include "shape/curve.h"

namespace tunica {

/// How points move along a line from a = 0 that grows at relative elemental rates g(a) (thesis 3.2): their speed is
/// v(a), the integral of g from 0 to a, and the time they take from one place to another is the integral of da / v.
/// That time is tabulated by Gauss's rule between the places where v is 0, so a(t) is found, not stepped; to 1e-10.
class Flow {
 public:
  explicit Flow(Curve rate);

  const Curve& rate() const { return rate_; }
  double speed(double a) const;
  /// Where a point that is at `a` is after the time dt, which may be negative. Points where v = 0 stay. Errors: a not
  /// finite or negative; dt not finite; a place beyond all numbers.
  double after(double a, double dt) const;

  /// Whether all that is at a > 0 moves away from the tip, so that time() holds.
  bool spreads() const { return last_ > 0 && reaches_.size() == 1 && reaches_[0].sign > 0 && reaches_[0].nodes.size() > 1; }
  double near() const { return reaches_[0].nodes.front().a; }  ///< a place close to the tip, from which time() counts
  double last() const { return last_; }  ///< from here on the rate is constant
  /// How long it takes from near() to a place between there and last(). Only where growth spreads().
  double time(double a) const;

 private:
  struct Node {
    double a, time;  ///< time from the first node, counted positive
  };
  /// Between two places where v = 0.
  struct Reach {
    double low, high;         ///< high may be infinite: v is linear beyond the last node
    int sign;                 ///< of v; 0: nothing moves
    double margin = 0;        ///< nearer than this to a place where v = 0, Law holds
    std::vector<Node> nodes;  ///< none: v is linear throughout
  };
  /// The speed away from a place where v = 0, at a small distance s from it: l s + c s^2.
  struct Law {
    double l, c;
    double after(double s, double t) const;
    double time(double from, double to) const;
  };
  std::vector<double> grid() const;
  void divide(const std::vector<double>& grid);
  void add_reach(double low, double high, bool moves, const std::vector<double>& grid);
  void add_nodes(Reach& reach, double from, double to, int depth) const;
  double time_between(double from, double to) const;
  double place_at(const Reach& reach, double time) const;
  Law law(double zero, double side, double margin) const;
  double move(const Reach& reach, double a, double dt) const;
  double move_in_tail(const Reach& reach, double a, double dt) const;
  double move_near(const Reach& reach, double zero, double side, double a, double dt) const;
  double move_by_table(const Reach& reach, double a, double dt) const;

  Curve rate_;
  double last_ = 0;
  double fastest_ = 0;  ///< largest |v| up to there
  std::vector<Reach> reaches_;
};

}  // namespace tunica
