// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>

#include "shape/curve.h"

namespace tunica {

/// A curve as the editors of L-Studio and vlab save it, all of them cubic B-splines: a function (.func, and in
/// galleries .fset, timelines .tset) or a planar contour (.con, galleries .cset).
struct DrawnCurve {
  bool is_function = false;
  std::string name;
  std::vector<Vec2> points;  ///< each as often as its multiplicity
  Ends ends = Ends::clamped;
  int samples = 0;            ///< that the editor's own programs take; not used here. 0: not given
  double start = 0, end = 0;  ///< in a timeline

  Curve function() const { return Curve(points); }
  BSpline contour() const { return {points, 3, ends}; }
};

/// Every curve of a file, at least one. Known: functions of version 1.0 and 1.1, contours of 1.0 to 1.4, all galleries;
/// keys in any order, lines that end in any way. Open contours are uniform (or, bspline) or start and end in their
/// outer points (oe); closed ones are uniform (cr), or return to their first point with a corner there (ce). Errors
/// name `file` and line: not such a file; cut; numbers that are none, or too many; a contour that is not planar; a
/// curve that cannot be drawn.
std::vector<DrawnCurve> read_lstudio(std::string_view text, const std::string& file);

/// A file of one contour (version 1.3) or one function (1.1), with every digit. A curve of lower degree becomes the
/// cubic that is the same curve. Errors: a degree that no cubic stands for (above 3; 2 with more than three points, or
/// not clamped).
std::string write_contour(const std::string& name, std::vector<Vec2> points, int degree, Ends ends);
std::string write_function(const std::string& name, const Curve& curve);

}  // namespace tunica
