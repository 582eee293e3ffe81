// SPDX-License-Identifier: MIT
#include "field/pattern.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "field/lattices.h"
#include "tissue/fixtures.h"

namespace tunica {
namespace {

using testing::degrees;
using testing::Known;
using testing::Lattice;
using testing::make;

/// The name, but for the pair in it: any of the right sequence may be the one in contact.
std::string kind_of(const std::string& name) { return name.substr(0, name.find(" (")); }

Lattice lattice_of(const Known& k, double noise) {
  Lattice l;
  l.angle = k.angle;
  l.jugacy = k.jugacy;
  l.whorls = k.jugacy == 1 ? 60 : 60 / k.jugacy + 4;
  l.rise = testing::rise_of(k);
  l.noise = noise;
  l.seed = 7;
  return l;
}

void expect_known(const Known& k, const Lattice& l, const std::string& what) {
  const Pattern p = read_pattern(make(l));
  EXPECT_EQ(kind_of(p.name), kind_of(k.name)) << what << ": " << describe(p);
  EXPECT_EQ(p.jugacy, k.jugacy) << what;
  EXPECT_NEAR(p.mean / degrees, k.angle, .2 + .1 * l.noise) << what;
  if (k.m == k.n) return;
  const Sequence came = sequence_of(p.contact.m, p.contact.n), expected = sequence_of(k.m, k.n);
  EXPECT_EQ(std::pair(came.first, came.second), std::pair(expected.first, expected.second))
      << what << ": " << describe(p);
}

TEST(Pattern, NamesThePatternsOfTheTable) {
  for (const Known& k : testing::table_4_2)
    for (const double rise : {.7, 1., 1.4})
      for (const double noise : {0., 1., 3.})
        for (const int hand : {1, -1})
          for (const bool times : {true, false}) {
            Lattice l = lattice_of(k, noise);
            l.rise *= rise;
            l.hand = hand;
            l.times = times;
            l.shuffled = hand < 0;
            expect_known(k, l, fmt::format("{} rise {} noise {} hand {} times {}", k.name, rise, noise, hand, times));
          }
}

TEST(Pattern, OrderIsMended) {
  for (const Known& k : testing::table_4_2) {
    if (k.jugacy > 1) continue;
    for (const int every : {4, 7, 20})
      for (const double noise : {0., 2.}) {
        auto items = make(lattice_of(k, noise));
        Index swaps = 0;
        for (size_t i = 1; i + 1 < items.size(); i += static_cast<size_t>(every), ++swaps)
          std::swap(items[i].angle, items[i + 1].angle), std::swap(items[i].place, items[i + 1].place);
        const Pattern p = read_pattern(items);
        EXPECT_EQ(kind_of(p.name), kind_of(k.name)) << every << ": " << describe(p);
        EXPECT_EQ(p.swaps, swaps) << k.name;
        EXPECT_NEAR(p.mean / degrees, k.angle, .5);
        EXPECT_LT(p.sd / degrees, 5);
        EXPECT_GT(p.raw_sd / degrees, 2 * p.sd / degrees);
        std::vector<Index> sorted = p.sequence;
        std::sort(sorted.begin(), sorted.end());
        for (size_t i = 0; i < sorted.size(); ++i) EXPECT_EQ(sorted[i], static_cast<Index>(i));
      }
  }
}

TEST(Pattern, MissingPartnersCostTheirWhorlAlone) {
  for (const Known& k : testing::table_4_2) {
    if (k.jugacy == 1) continue;
    for (const bool times : {true, false}) {
      Lattice l = lattice_of(k, 2);
      l.whorls = 16;
      l.times = times;
      l.shuffled = true;
      l.lag = .3 / (k.jugacy - 1);
      auto items = make(l);
      for (int q = 0; q < 3; ++q) items.erase(items.begin() + (4 + 3 * q) * k.jugacy + q % k.jugacy - q);
      const Pattern p = read_pattern(items);
      EXPECT_EQ(p.name, k.name) << describe(p);
      EXPECT_EQ(p.missing, 3) << k.name;
      EXPECT_EQ(p.whorls, 16) << k.name;
      EXPECT_NEAR(p.mean / degrees, k.angle, .6) << k.name;
    }
  }
}

Pattern of(double angle, int jugacy, double rise, double noise = 0) {
  Lattice l;
  l.angle = angle;
  l.jugacy = jugacy;
  l.rise = rise;
  l.noise = noise;
  l.shuffled = true;
  return read_pattern(make(l));
}

TEST(Pattern, NamesWhatAlternatesOrNearlyDoes) {
  for (const double noise : {0., 2., 5.}) {
    EXPECT_EQ(of(180, 1, .8, noise).name, "distichous");
    EXPECT_EQ(of(160, 1, 1, noise).name, "spiro-distichous");
    EXPECT_EQ(of(145.6, 1, 1.2, noise).name, "spiro-distichous");
    EXPECT_EQ(of(90, 2, .8, noise).name, "decussate");
    EXPECT_EQ(of(80, 2, .8, noise).name, "spiro-decussate");
    EXPECT_EQ(of(60, 3, .6, noise / 2).name, "tricussate");
    EXPECT_EQ(of(45, 4, .6, noise / 2).name, "whorled of 4");
    EXPECT_EQ(of(69, 2, .2, noise).name, "bijugate Fibonacci spiral");
    EXPECT_EQ(of(0, 2, .4, noise).name, "superposed whorls of 2");
  }
}

TEST(Pattern, LowOrderIsNamedByThePair) {
  // Away from its limit, Lucas passes through the angle of <3, 7, 10>; Fibonacci is at 139 to 142.
  EXPECT_EQ(of(105.5, 1, .45).name, "Lucas spiral");
  EXPECT_EQ(of(103.5, 1, .25).name, "Lucas spiral");
  EXPECT_EQ(of(106.45, 1, .05).name, "other (7,10)");
  EXPECT_EQ(of(139.3, 1, .4).name, "Fibonacci spiral");
  EXPECT_EQ(of(139.3, 1, .4).contact, (ParastichyPair{2, 3}));
  EXPECT_EQ(of(142, 1, .3).name, "Fibonacci spiral");
}

TEST(Pattern, RandomAnglesHaveNoName) {
  std::mt19937 random(5);
  int named = 0;
  for (int trial = 0; trial < 1000; ++trial) {
    std::vector<PatternItem> items;
    for (int i = 0; i < 8 + trial % 60; ++i) {
      PatternItem item;
      item.angle = random() / 4294967296. * 360 * degrees;
      if (trial % 2) item.time = i;
      if (trial % 3) item.place = {std::cos(item.angle), .1 * i, std::sin(item.angle)};
      items.push_back(item);
    }
    named += read_pattern(items).kind != PatternKind::none;
  }
  EXPECT_LE(named, 2);
}

std::vector<PatternItem> from_divergences(const std::vector<double>& list) {
  std::vector<PatternItem> items(1);
  for (const double d : list) {
    PatternItem item;
    item.angle = items.back().angle + d * degrees;
    items.push_back(item);
  }
  return items;
}

TEST(Pattern, NoisySpiralsOfModelsAreFibonacci) {
  // Initiation by transport on growing cells.
  const Pattern a =
      read_pattern(from_divergences({125, 135, 124, 133, 128, 127, 131, 142, 138, 126, 142, 112, 161, 111, 158,
                                     114, 143, 128, 126, 135, 127, 136, 129, 125, 147, 104, 147, 122, 128, 133}));
  EXPECT_EQ(a.name, "Fibonacci spiral");
  EXPECT_EQ(a.swaps, 0);
  EXPECT_NEAR(a.mean / degrees, 131.23, .01);
  EXPECT_NEAR(a.sd / degrees, 12.56, .01);
  const Pattern b = read_pattern(from_divergences(
      {140, 126, 132, 132, 123, 142, 112, 137, 126, 142, 135, 133, 114, 139, 149, 116, 139, 149, 131, 133}));
  EXPECT_EQ(b.name, "Fibonacci spiral");
  EXPECT_EQ(b.hand, 1);
}

TEST(Pattern, ReversalsAreCountedAndFolded) {
  std::vector<double> list(12, 137);
  for (int i = 0; i < 10; ++i) list.push_back(-137);
  const Pattern p = read_pattern(from_divergences(list));
  EXPECT_EQ(p.reversals, 1);
  EXPECT_TRUE(p.folded);
  EXPECT_EQ(p.name, "Fibonacci spiral");
  EXPECT_NEAR(p.folded_mean / degrees, 137, 1e-9);
  EXPECT_EQ(p.hand, 1);
}

TEST(Pattern, PlastochronsAndRatio) {
  std::vector<PatternItem> items;
  for (int i = 0; i < 20; ++i) {
    PatternItem item;
    item.angle = i * 137.5 * degrees;
    item.time = .5 * i;
    const double r = std::pow(1.2, 19 - i);
    item.place = {r * std::cos(item.angle), 0, r * std::sin(item.angle)};
    items.push_back(item);
  }
  const Pattern p = read_pattern(items);
  EXPECT_NEAR(p.plastochron.mean, .5, 1e-12);
  EXPECT_NEAR(p.plastochron.sd, 0, 1e-12);
  EXPECT_EQ(p.plastochron.count, 19);
  EXPECT_NEAR(p.plastochron_ratio.mean, 1.2, 1e-12);
  EXPECT_EQ(p.name, "Fibonacci spiral");
  EXPECT_FALSE(p.evidence.empty());
}

TEST(Pattern, ShortListsAreToldSo) {
  for (int n = 0; n <= 5; ++n) {
    const Pattern p = read_pattern(from_divergences(std::vector<double>(static_cast<size_t>(n), 137)));
    if (n < 5) {
      EXPECT_EQ(p.name, "too few");
      EXPECT_NE(describe(p).find("too few"), std::string::npos);
    }
    EXPECT_EQ(p.divergences.size(), static_cast<size_t>(n));
  }
  EXPECT_EQ(read_pattern({}).name, "too few");
  EXPECT_EQ(read_pattern({}, {3}).name, "too few");
  EXPECT_EQ(read_pattern(std::vector<PatternItem>(7), {3}).jugacy, 3);
}

TEST(Pattern, BadListsAreRefused) {
  std::vector<PatternItem> items(3);
  items[1].angle = NAN;
  EXPECT_ERROR(read_pattern(items), "primordium 2");
  items[1].angle = 1;
  for (int i = 0; i < 3; ++i) items[static_cast<size_t>(i)].time = -i;
  EXPECT_ERROR(read_pattern(items), "oldest first");
  EXPECT_ERROR(read_pattern({}, {101}), "jugacy");
}

TEST(Pattern, JudgesByTheRulesOfTheTables) {
  for (const Known& k : testing::table_4_2) {
    const ExpectedPattern expected{k.angle * degrees, k.jugacy, {k.m, k.n}};
    const Judgement good = judge(read_pattern(make(lattice_of(k, .5)), {k.jugacy}), expected);
    EXPECT_TRUE(good.lenient && good.strict && good.hold) << k.name << ": " << good.why;
    Lattice off = lattice_of(k, 0);
    off.angle -= k.angle > 100 ? 30 : 15;
    const Judgement bad = judge(read_pattern(make(off), {k.jugacy}), expected);
    EXPECT_FALSE(bad.strict || bad.hold) << k.name;
    EXPECT_FALSE(bad.why.empty());
  }
  const Pattern fibonacci = of(139.5, 1, .4);
  EXPECT_TRUE(judge(fibonacci, {137.51 * degrees, 1, {}}).lenient);
  EXPECT_FALSE(judge(fibonacci, {137.51 * degrees, 1, {}}).strict);
  EXPECT_FALSE(judge(fibonacci, {68.75 * degrees, 2, {}}).lenient);
  // (3,4) at 105.5 degrees is near the angle of <3, 7, 10>, but not of that sequence.
  EXPECT_NE(judge(of(105.5, 1, .3), {106.45 * degrees, 1, {}}).why.find("is not of <3, 7"), std::string::npos);
  EXPECT_ERROR(judge(fibonacci, {137.51 * degrees, 2, {}}), "divergence expected");
  EXPECT_ERROR(judge(fibonacci, {68.75 * degrees, 2, {3, 5}}), "jugacy");
}

TEST(Pattern, TenThousandPrimordiaAreReadAtOnce) {
  Lattice l;
  l.whorls = 10000;
  l.rise = .002;
  l.noise = .05;
  const Pattern p = read_pattern(make(l));
  EXPECT_EQ(p.name, "Fibonacci spiral");
  EXPECT_NEAR(p.mean / degrees, 137.508, .001);
}

}  // namespace
}  // namespace tunica
