// SPDX-License-Identifier: MIT
// The order along the generative spiral. Primordia that arise nearly at the same time often come in the wrong order,
// with the right places; the divergence angles then read 41, 83, -41 in place of 41, 41, 41.
#include <algorithm>
#include <array>
#include <cmath>

#include "field/pattern_parts.h"

namespace tunica::pattern {

namespace {

constexpr Index window = 4;
constexpr double widest = 25 * degree;    // error up to which a divergence counts as the spiral's
constexpr double clearly = 15 * degree;   // by which another primordium must fit better than the oldest one left
constexpr double apart = 1.5;             // plastochrons
constexpr double most_swaps = .6;         // of the number of primordia
constexpr double lost = 1;                // evidence that a divergence out of order speaks against a spiral
constexpr double inexact = .5;            // what a divergence at the limit of error lacks in evidence
constexpr double smallest = 20 * degree;  // divergence of a spiral along which the order is mended
constexpr double better = .7;             // sd of the mended divergences, at most, against that before
const double least_evidence = std::log(1000. * 40);  // one in a thousand by chance, for the number of angles tried

struct Walk {
  std::vector<Index> sequence;
  double evidence = 0;  ///< log of how unlikely the fit would be among random angles
};

/// The oldest primordia that have no place yet.
class Waiting {
 public:
  explicit Waiting(Index count) : count_(count) { fill(); }
  Index size() const { return size_; }
  Index operator[](Index i) const { return left_[static_cast<size_t>(i)]; }
  bool passed_over() const { return skipped_[0] >= window - 1; }  ///< the oldest, as often as may be
  Index take(Index i) {
    const Index taken = left_[static_cast<size_t>(i)];
    for (Index k = 0; k < i; ++k) ++skipped_[static_cast<size_t>(k)];
    for (Index k = i; k + 1 < size_; ++k) {
      left_[static_cast<size_t>(k)] = left_[static_cast<size_t>(k) + 1];
      skipped_[static_cast<size_t>(k)] = skipped_[static_cast<size_t>(k) + 1];
    }
    --size_;
    fill();
    return taken;
  }

 private:
  void fill() {
    while (size_ < window && next_ < count_) {
      left_[static_cast<size_t>(size_)] = next_++;
      skipped_[static_cast<size_t>(size_++)] = 0;
    }
  }
  std::array<Index, window> left_{};
  std::array<int, window> skipped_{};
  Index size_ = 0, next_ = 0, count_;
};

double error_of(const std::vector<PatternItem>& items, Index from, Index to, double divergence) {
  return std::fabs(wrap(items[static_cast<size_t>(to)].angle - items[static_cast<size_t>(from)].angle - divergence));
}

/// Follows a divergence, starting at the start-th primordium; with `in_order`, takes them as they come.
Walk walk(const std::vector<PatternItem>& items, const std::vector<double>& plastochron, double divergence, Index start,
          bool in_order = false) {
  const double tolerance = std::min(widest, std::fabs(divergence) / 2);
  const double chance = tolerance / std::numbers::pi;
  const auto together = [&](Index a, Index b) {
    if (plastochron.empty()) return true;
    const auto i = static_cast<size_t>(a), k = static_cast<size_t>(b);
    return items[k].time - items[i].time <= apart * plastochron[i];
  };
  Walk result;
  Waiting waiting(static_cast<Index>(items.size()));
  while (start > 0 && !together(0, start)) --start;
  result.sequence.push_back(waiting.take(start));
  while (waiting.size() > 0) {
    const Index at = result.sequence.back();
    const double first = error_of(items, at, waiting[0], divergence);
    double least = first;
    Index best = 0;
    for (Index k = 1; k < waiting.size() && !in_order && !waiting.passed_over(); ++k) {
      const double error = error_of(items, at, waiting[k], divergence);
      if (error < least && error <= tolerance && error < first - clearly && together(waiting[0], waiting[k])) {
        least = error;
        best = k;
      }
    }
    if (least > tolerance)
      result.evidence -= lost;
    else
      result.evidence -=
          std::log(std::min(1., best == 0 ? chance : chance * window)) + inexact * std::pow(least / tolerance, 2);
    result.sequence.push_back(waiting.take(best));
  }
  return result;
}

/// The middles of the two most frequent classes of divergence, 5 degrees wide and joined with their neighbours.
std::vector<double> frequent(const std::vector<PatternItem>& items) {
  constexpr int classes = 72;
  std::array<int, classes> count{};
  const auto class_of = [](double angle) {
    return std::clamp(static_cast<int>((wrap(angle) + turn / 2) / turn * classes), 0, classes - 1);
  };
  for (size_t i = 1; i < items.size(); ++i) ++count[static_cast<size_t>(class_of(items[i].angle - items[i - 1].angle))];
  std::vector<std::pair<int, int>> order;
  for (int c = 0; c < classes; ++c) {
    const auto at = [&](int k) { return count[static_cast<size_t>((k + classes) % classes)]; };
    order.emplace_back(-(at(c - 1) + at(c) + at(c + 1)), c);
  }
  std::sort(order.begin(), order.end());
  std::vector<double> angles;
  for (int i = 0; i < 2; ++i) angles.push_back((order[static_cast<size_t>(i)].second + .5) / classes * turn - turn / 2);
  return angles;
}

/// Divergences to try, both hands: the frequent ones, and the limits of sequences.
std::vector<double> divergences_to_try(const std::vector<PatternItem>& items) {
  std::vector<double> list = frequent(items);
  const std::pair<int, int> seeds[] = {{1, 2}, {1, 3}, {1, 4}, {1, 5}, {1, 6}, {1, 7}, {1, 8},
                                       {2, 5}, {2, 7}, {2, 9}, {3, 7}, {3, 8}, {4, 9}, {5, 11}};
  for (const auto& [m, n] : seeds)
    for (const int hand : {1, -1}) list.push_back(hand * sequence_of(m, n).limit);
  return list;
}

std::vector<double> divergences_of(const std::vector<PatternItem>& items, const std::vector<Index>& sequence) {
  std::vector<double> list;
  for (size_t i = 1; i < sequence.size(); ++i)
    list.push_back(
        wrap(items[static_cast<size_t>(sequence[i])].angle - items[static_cast<size_t>(sequence[i - 1])].angle));
  return list;
}

/// The mean of those divergences of a walk that are near the one followed.
double refine(const std::vector<double>& divergences, double followed) {
  std::vector<double> near;
  for (const double d : divergences)
    if (std::fabs(wrap(d - followed)) <= std::min(widest, std::fabs(followed) / 2)) near.push_back(d);
  return near.empty() ? followed : circular(near).mean;
}

/// Pairs that are in the other order. None is displaced by more than `window`.
Index exchanges(const std::vector<Index>& sequence) {
  Index count = 0;
  for (size_t i = 0; i < sequence.size(); ++i)
    for (size_t k = i + 1; k < std::min(i + 2 * window, sequence.size()); ++k)
      count += sequence[k] < sequence[i] ? 1 : 0;
  return count;
}

}  // namespace

Spiral best_spiral(const std::vector<PatternItem>& items, const std::vector<double>& plastochron) {
  Spiral result;
  for (size_t i = 0; i < items.size(); ++i) result.sequence.push_back(static_cast<Index>(i));
  result.divergences = divergences_of(items, result.sequence);
  if (items.size() < 6) return result;
  double followed = 0, best = -1e300, plain = -1e300;
  for (const double d : divergences_to_try(items)) {
    plain = std::max(plain, walk(items, plastochron, d, 0, true).evidence);
    const double evidence = walk(items, plastochron, d, 0).evidence;
    if (evidence > best) {
      best = evidence;
      followed = d;
    }
  }
  followed = refine(divergences_of(items, walk(items, plastochron, followed, 0).sequence), followed);
  Walk found = walk(items, plastochron, followed, 0);
  for (Index start = 1; start < window; ++start) {
    Walk other = walk(items, plastochron, followed, start);
    if (other.evidence > found.evidence + 1) found = std::move(other);
  }
  if (std::fabs(followed) < smallest || found.evidence < least_evidence || found.evidence < plain + 2) return result;
  const Index swaps = exchanges(found.sequence);
  if (swaps > most_swaps * static_cast<double>(items.size())) return result;
  std::vector<double> mended = divergences_of(items, found.sequence);
  if (circular(mended).sd > better * circular(result.divergences).sd) return result;
  return {std::move(found.sequence), swaps, std::move(mended)};
}

}  // namespace tunica::pattern
