// SPDX-License-Identifier: MIT
#pragma once

#include "view/gl.h"
#include "view/projector.h"
#include "view/scene.h"

namespace tunica {

/// Turns what a scene has in space (faces, bands, lines, markers) into triangles on the screen, shaded.
/// Errors: indices outside the points; places that are not finite.
void tessellate(const Scene& scene, const Projector& projector, std::vector<Vertex>& triangles);

/// A filled rectangle, for legends.
void add_rectangle(std::vector<Vertex>& triangles, const Rect& rect, const Colour& colour);

}  // namespace tunica
