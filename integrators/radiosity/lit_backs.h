// SPDX-License-Identifier: Apache-2.0
// Shapes whose backs light may reach: a path of diffuse reflections from there arrives at a point that a light shines
// on. The inside of a closed body is dark, also where other bodies stand into it; the inside of a room is not.
#pragma once

#include <vector>

#include "integrators/radiosity/patches.h"

namespace iride::radiosity {

// [shape]. `tracer`: of the fronts.
std::vector<bool> lit_backs(Scene const& scene, PatchMesh const& fronts, PatchTracer const& tracer);

}  // namespace iride::radiosity
