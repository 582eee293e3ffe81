// SPDX-License-Identifier: MIT
#include <cmath>

#include "base/error.h"
#include "tissue/builders.h"
#include "tissue/division.h"
#include "tissue/order.h"

namespace tunica {

Tissue sheet(const SheetSettings& settings) {
  if (settings.cells < 1 || settings.cells > 2'000'000)
    fail("the number of cells of a sheet must be between 1 and 2000000, not {}", settings.cells);
  if (!(settings.max_area > 0) || !std::isfinite(settings.max_area))
    fail("the area at which cells divide must be positive, not {}", settings.max_area);
  if (!(settings.growth > 0 && settings.growth <= 1))
    fail("the growth between divisions must be above 0 and at most 1, not {}", settings.growth);
  Tissue tissue = polygon(8, settings.max_area / 2, settings.seed);
  const double factor = std::sqrt(1 + settings.growth);
  while (tissue.cells() < settings.cells) {
    poll(settings.cancel);
    // Growing uniformly from the middle cannot fold a cell, so nothing needs to be checked here.
    for (Index j = 0; j < tissue.junctions(); ++j) tissue.set_position(j, factor * tissue.position(j));
    tissue.refresh_geometry();
    divide_above(tissue, {settings.max_area, settings.variation, settings.cells}, errera, {}, nullptr, settings.cancel);
  }
  renumber_along_curve(tissue);
  return tissue;
}

}  // namespace tunica
