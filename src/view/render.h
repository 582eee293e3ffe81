// SPDX-License-Identifier: MIT
#pragma once

#include "view/picture.h"
#include "view/scene.h"

namespace tunica {

/// Draws a scene off screen. The same scene gives the same pixels on one machine. Each thread keeps its own renderer;
/// a process that has drawn must not fork without exec (the renderer's threads would be missing in the child).
/// Errors: size outside 16 .. 16384; something not finite to draw; no renderer (libosmesa6), or, when there is text,
/// no font (fonts-dejavu-core); Cancelled.
Picture render(const Scene& scene);

/// Name and version of what draws, for the record of a run: "llvmpipe ...". Errors: as render.
const char* renderer_name();

}  // namespace tunica
