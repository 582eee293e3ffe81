// SPDX-License-Identifier: MIT
// Compiled once per instruction set with TUNICA_ISA (namespace) set; nothing here calls inline library code.

#include "base/lanes.inl"
#include "tissue/outline_kernels.h"

namespace tunica::TUNICA_ISA {
namespace {

#include "tissue/outline.inl"

struct Outline {
  const FourOutlines& o;
  int count;
  Four corners;
  Point<Four> corner(int i) const { return {load(o.x[i]), load(o.y[i]), load(o.z[i])}; }
  Mask has(int i) const { return all(i) < corners; }
  /// Corner place[k] of outline k.
  Point<Four> of_each(const int* place) const {
    Point<Four> p;
    for (int k = 0; k < 4; ++k) p.x[k] = o.x[place[k]][k], p.y[k] = o.y[place[k]][k], p.z[k] = o.z[place[k]][k];
    return p;
  }
  Point<Four> quarter(int quarters) const {
    int place[4];
    for (int k = 0; k < 4; ++k) place[k] = quarters * o.corners[k] / 4;
    return of_each(place);
  }
  Point<Four> last() const {
    int place[4];
    for (int k = 0; k < 4; ++k) place[k] = o.corners[k] - 1;
    return of_each(place);
  }
};

inline Four corners_of(const FourOutlines& four) {
  return __builtin_convertvector(*reinterpret_cast<const FourSteps*>(four.corners), Four);
}

int measure(const FourOutlines& four, FourMeasures& m) {
  const Outline o{four, four.count, corners_of(four)};
  const auto [average, in_plane, not_flat] = spread<Four, Mask>(o, o.corners);
  const FanMeasure<Four> fan = measure_fan<Four>(o, average);
  store(m.area, fan.area);
  store(m.x, fan.centroid.x);
  store(m.y, fan.centroid.y);
  store(m.z, fan.centroid.z);
  return bits_of(not_flat & ~in_plane);
}

int plain(const FourOutlines& four, const double (*outward)[4]) {
  const Outline o{four, four.count, corners_of(four)};
  return bits_of(is_plain<Mask>(o, Point<Four>{load(outward[0]), load(outward[1]), load(outward[2])}));
}

}  // namespace

const OutlineKernels& outline_kernels() {
  static const OutlineKernels set{measure, plain};
  return set;
}

}  // namespace tunica::TUNICA_ISA
