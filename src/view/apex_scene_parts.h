// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <utility>
#include <vector>

#include "view/apex_scene.h"

namespace tunica {

/// An apex with what was left open filled in, and everything checked.
struct DrawnApex {
  DrawnApex(const ApexPicture& apex, const ApexView& view);

  const ApexPicture& given;
  const ApexView& view;
  Turned surface;
  double reach = 0;             ///< arc to which the surface is shown
  double limit = INFINITY;      ///< arc to which primordia are shown
  std::vector<Bump> primordia;  ///< radius, height and number set; also those not shown, so that indices stay
  std::vector<double> values;   ///< per primordium, what colours it; empty: plain
  double min = 0, max = 1;      ///< ends of the colour scale
  Palette palette;

  bool shown(size_t i) const { return primordia[i].arc <= limit; }
  bool by_field() const { return view.by == ApexView::By::field; }
  Colour colour(size_t i) const { return values.empty() ? view.plain : scaled(values[i]); }
  Colour scaled(double value) const { return palette.at((value - min) / (max - min)); }
  /// How high the bumps stand above the surface at a place.
  double lift(double theta, double arc) const;

 private:
  void fill_in();
  void choose_colours();
};

/// Two primordia that follow each other on a parastichy; the angle goes from that of `from` by `turn` radians.
struct Link {
  size_t from, to;
  double turn;
};

/// The links of both families of a contact pair: i with i + m, and i with i + n. Of the members of a whorl that
/// partner is taken which lies nearest to where the family's mean turn leads; links that stray by more than half the
/// distance between neighbouring parastichies are left out.
std::pair<std::vector<Link>, std::vector<Link>> parastichies(const std::vector<Bump>& primordia,
                                                             std::pair<int, int> pair, int jugacy);

/// A local minimum of a field around the ring; of values in a row that are alike the middle counts.
struct Minimum {
  double angle;
  double depth;  ///< below what three quarters of the ring stay under, relative to the deepest; 0: above that
  bool chosen;
};
std::vector<Minimum> minima_of(const FieldRing& ring);

/// Parts of scene_of_apex.
void add_apex_surface(const DrawnApex& apex, Scene& scene);
void add_bumps(const DrawnApex& apex, Scene& scene);
void add_ring(const DrawnApex& apex, Scene& scene);
void add_arrows(const DrawnApex& apex, Scene& scene);

/// The colours of the two families of parastichies, and their keys in the legend.
Colour family_colour(int family);
void add_family_keys(const DrawnApex& apex, Scene& scene);
std::string legend_title_of(const ApexView& view);

}  // namespace tunica
