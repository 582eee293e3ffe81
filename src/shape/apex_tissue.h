// SPDX-License-Identifier: MIT
#pragma once

#include "base/cancel.h"
#include "shape/apex.h"

namespace tunica {

/// Cells on the tip of an apex, grown from one octagon at the tip by the growth of the apex and by division.
struct ApexTissueSettings {
  double to = 0;          ///< arc length that they reach: those stay whose centroid is not beyond it; 0: see `cells`
  int64_t cells = 0;      ///< instead: as soon as there are so many
  double max_area = .01;  ///< area at which a cell divides; the mean comes to about 0.7 of it
  double variation = .3;  ///< of that threshold from cell to cell, uniform, relative
  double growth = .02;    ///< relative growth of areas between divisions, at most, where growth is fastest
  uint64_t seed = 1;      ///< of the threshold's variation
  const CancelFlag* cancel = nullptr;
};
/// Errors: settings out of range; not one of `to` and `cells`; a hole at the tip; growth that does not take the cells
/// so far; more than 1,000,000 cells; Cancelled.
Tissue apex_tissue(const Apex& apex, const ApexTissueSettings& settings);

/// The apex that a surface is, or bulges out of; nullptr: neither.
const Apex* apex_below(const Surface& surface);

/// Adds columns `theta` (degrees, above -180, at most 180; 0 on the axis) and `a` (arc length from the tip) to the
/// cells where they are missing, and sets them to the places of the centroids.
void locate(Tissue& tissue, const Apex& apex);
/// Brings columns `theta` and `a` up to date if the surface is an apex or bulges out of one, and `primordium` and
/// `closeness` (bulges.h) if it bulges; those that the tissue has. @param only  cells that are looked at; those that
/// are gone are not
void follow(Tissue& tissue, const Surface& surface);
void follow(Tissue& tissue, const Surface& surface, const std::vector<Id>& only);

/// Removes the cells whose centroid is farther from the tip than an arc length. @return how many. Errors: a not finite;
/// no geometry; locked; nothing would be left.
int64_t remove_beyond(Tissue& tissue, const Apex& apex, double a);

}  // namespace tunica
