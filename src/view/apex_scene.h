// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "view/palette.h"
#include "view/scene.h"
#include "view/turned.h"

namespace tunica {

/// A primordium as it is shown. Lengths are in the world's unit, angles in radians.
struct Bump {
  double theta = 0, arc = 0;     ///< place on the apex; arc: along the profile from the tip
  double age = 0;                ///< time since it arose
  std::optional<double> radius;  ///< else as large as its neighbours leave room for
  std::optional<double> height;  ///< of the bump above the surface; else half the radius
  double value = 0;              ///< to colour by
  std::optional<int> number;     ///< as it is labelled; else its place in the list, from 1
};

/// The ring on which primordia arise, and the inhibition at its sampling points.
struct FieldRing {
  double arc = 0;
  std::vector<double> angles, values;  ///< radians, ascending through one turn; empty: the ring alone
  std::optional<double> threshold;
  std::optional<double> chosen;  ///< angle of the minimum that is taken; else the lowest
};

/// Values on the surface: `values[k * angles + i]` at angle 2 pi i / angles, arc `arcs[k]` (ascending).
struct SurfaceField {
  int angles = 0;
  std::vector<double> arcs, values;
  bool given() const { return !values.empty(); }
};

/// An apex with its primordia, as plain data.
struct ApexPicture {
  std::vector<Vec2> profile;    ///< (x, y) from the tip outwards; see Turned
  std::vector<Bump> primordia;  ///< in the order in which they arose
  std::optional<FieldRing> ring;
  SurfaceField field;
  std::optional<std::pair<int, int>> pair;  ///< contact parastichies (m, n)
  int jugacy = 1;                           ///< primordia per whorl: successive ones in the list
};

/// How an apex is shown.
struct ApexView {
  enum class From { top, oblique, side };
  enum class By { plain, age, size, value, field };
  enum class Map { angles_kept, arc, log_radius };  ///< what is upright in an unrolled lattice

  int width = 0, height = 0;  ///< pixels; 0: chosen
  std::string title;
  Colour background = white;
  From from = From::top;
  double turn = 0, zoom = 1;  ///< turn: of the apex about its axis, radians
  By by = By::age;            ///< colour of primordia; field: of the surface or the ring
  std::optional<Palette> palette;
  std::optional<double> min, max;  ///< ends of the colour scale
  std::string legend_title;
  bool legend = true;
  Colour surface = parse_colour("#cfe0b0"), plain = parse_colour("#93b866");
  bool parastichies = false, labels = false, arrows = false;
  std::optional<double> reach;  ///< arc to which the surface is shown; else as far as there are primordia
  Map map = Map::angles_kept;
  const CancelFlag* cancel = nullptr;  ///< polled while the scene is made and drawn
};

/// The apex in space: its surface lit, primordia as bumps, field, ring, parastichies. Seen from above, angles run
/// clockwise from the right, as (3.1) with y upwards has it. Errors: as Turned; numbers that are not finite or sizes
/// that are not positive, named; a field whose counts do not fit; something asked for that the data lacks.
Scene scene_of_apex(const ApexPicture& apex, const ApexView& view);

/// The apex unrolled: angle across, distance from the tip downwards; primordia as discs (circles where the map keeps
/// angles). Errors: as scene_of_apex.
Scene scene_of_lattice(const ApexPicture& apex, const ApexView& view);

}  // namespace tunica
