// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/bytes.h"
#include "base/cancel.h"
#include "field/field_rule.h"
#include "field/pair_kernels.h"
#include "tissue/tissue.h"

namespace tunica {

using Vec2 = Eigen::Vector2d;

struct Primordium {
  double angle = 0;  ///< radians
  double birth = 0;  ///< time at which it was on the ring
  bool initial = false;
};

/// One inhibitor: a candidate is a place where its field is below the threshold.
struct InhibitionField {
  std::unique_ptr<FieldRule> rule;
  std::function<double(double t)> threshold;
  bool varies = false;       ///< the threshold changes with time, or the rule: nothing follows from a pause
  bool rule_varies = false;  ///< the rule's shares depend on time, not only on age: old primordia are never left out
};

struct InhibitionSettings {
  Vec2 ring{1, 0};                              ///< its distance from the axis (> 0) and its height
  std::function<Vec2(double age)> track;        ///< where what starts on the ring is at an age
  std::function<Vec2(double along)> displaced;  ///< the ring, moved so far along the profile; for jitter
  int samples = 360;
  int jugacy = 1;           ///< so many primordia at once, evenly spaced; must divide `samples`
  double tie = 1e-9;        ///< fields nearer than this (relative) are equal
  double tolerance = 1e-3;  ///< of the time of an insertion, relative to the plastochron
  double longest_step = 0;  ///< 0: no limit but half a plastochron
  bool located = true;      ///< false: insertions happen at the end of fixed steps of longest_step
  double drop =
      1e-9;  ///< old primordia are left out while their share of each field is below this part of the threshold
  int most_active = 5000;                     ///< and beyond so many
  double jitter_angle = 0, jitter_along = 0;  ///< standard deviations (radians, length) of the places of samples
  uint64_t seed = 1;
  const CancelFlag* cancel = nullptr;
};

/// Phyllotaxis by inhibition fields (thesis chapter 4): primordia are born on the ring of a growing surface of
/// revolution and move away along its profile, all on the same track. Fields are evaluated on samples of the ring;
/// where all are below their thresholds, primordia are inserted, at the time at which this comes true.
class Inhibition {
 public:
  /// Errors: settings that cannot be (named); a ring that does not move.
  explicit Inhibition(InhibitionSettings settings);

  void add_field(InhibitionField field);
  size_t fields() const { return fields_.size(); }
  InhibitionField& field(size_t k) { return fields_[k]; }

  /// Adds a primordium that is `age` old now. Errors: age < 0 or not finite; a younger one is there already.
  void add_primordium(double angle, double age);
  /// Whorls of `jugacy` with this divergence angle before the first insertion, which is then due now at angle 0.
  /// Without a spacing in time: the uniform plastochron at which the first field, of these whorls alone, is at its
  /// threshold there (largest such plastochron; where there is none, that of the largest field). Returns the
  /// plastochron. Errors: some are there already.
  double add_lattice(int whorls, double angle, int jugacy, std::optional<double> plastochron);
  /// One at a random place, now.
  void add_random();

  enum class Status : uint8_t { reached, inserted, clear, interrupted };
  /// Goes on to `to`, or to the next insertion, or to the end of a search interval, whichever comes first. What it is
  /// called with changes no insertion. Errors: thresholds or fields not finite (time, distance, age named); insertions
  /// without end.
  Status advance(double to);
  /// Until when it is known that nothing happens: the next insertion or the end of the search interval. Errors: as
  /// advance(), and Cancelled.
  double known_until();
  /// Goes to a time from now to known_until(), or back to one after the last insertion, without an insertion.
  void show(double t);
  /// Parameters or thresholds have changed: what was found for times to come is void, searching starts from now.
  void changed();
  /// As changed(), where only thresholds may have.
  void reconsider();

  double time() const { return time_; }
  double searched_from() const { return from_; }  ///< since when nothing was inserted or changed, and all is known
  uint64_t evaluations() const { return evaluations_; }
  uint64_t pairs() const { return pair_count_; }
  uint64_t steps() const { return steps_; }
  const std::vector<Primordium>& primordia() const { return primordia_; }
  size_t first_active() const { return first_active_; }
  /// Mean time between insertions lately; 0 while unknown.
  double plastochron() const;
  /// A time in which the ring's points move by a hundredth of its radius.
  double time_scale() const { return time_scale_; }
  /// Time of the last insertion or initial primordium; -infinity without any.
  double last_birth() const { return primordia_.empty() ? -1e300 : primordia_.back().birth; }
  /// Whether old primordia were left out only because there were too many.
  bool overflowed() const { return overflowed_; }
  Vec2 place(const Primordium& p) const { return track(time_ - p.birth); }
  /// The older primordia nearest to one when it arose, in space, on either side of it (at a falling and at a rising
  /// angle): their places in primordia(), or none. Parastichies run through them.
  std::pair<Index, Index> neighbours(size_t primordium) const;

  /// Field k now at a place (angle, distance from the axis, height).
  double value(size_t k, double angle, const Vec2& place);
  /// Field k on the samples now (mean over the places of a whorl where jugacy is imposed), and where they are.
  std::vector<double> ring_values(size_t k);
  const std::vector<double>& angles() const { return angle_; }
  struct Minimum {
    double angle, value;
    bool candidate;
  };
  /// The lowest place of the first field among the candidates, or among all if there is none. Now.
  Minimum minimum();

  void save(ByteWriter& out) const;
  /// Errors: damaged, or of a ring with other settings.
  void load(ByteReader& in);

 private:
  struct Ahead {
    double end;
    bool insertion;
  };
  Vec2 track(double age) const;
  void place_samples();
  void evaluate(double t);
  void add_source(const Primordium& p, double t);
  [[noreturn]] void blame(size_t k, double t);
  double excess(double t);
  double threshold(size_t k, double t) const;
  int places() const { return settings_.samples / settings_.jugacy; }
  double decisive(size_t k, int place) const;
  double next_step() const;
  Ahead look_ahead();
  double locate(double low, double g_low, double high, double g_high);
  int choose(double t);
  void insert(double t);
  void leave_out_old(double t);
  double largest_share(size_t k, double age, double t);
  double lattice_sum(int whorls, double angle, int jugacy, double plastochron);
  void check_empty() const;

  InhibitionSettings settings_;
  std::vector<InhibitionField> fields_;
  std::vector<Primordium> primordia_;
  size_t first_active_ = 0;
  double time_ = 0, from_ = 0, time_scale_ = 0;
  uint64_t draws_ = 0;  ///< insertions so far, for random numbers
  std::optional<Ahead> ahead_;
  bool recount_ = true;  ///< which primordia count is to be found anew
  bool overflowed_ = false;
  uint64_t evaluations_ = 0, pair_count_ = 0, steps_ = 0;

  std::vector<double> angle_;  ///< of samples, radians
  AlignedBuffer sine_, cosine_, radius_, height_, distance_;
  std::vector<AlignedBuffer> h_;
  std::optional<double> evaluated_;  ///< time for which h_ holds
};

}  // namespace tunica
