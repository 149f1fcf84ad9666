// SPDX-License-Identifier: Apache-2.0
// Patch values to vertices, for interpolation. A vertex inside a surface takes the mean of its patches by open area.
// For one on the surface's border that mean stands half way to the nearest inner vertex n: b_v = 2 mean - b_n. [Cohen
// 1985]
#pragma once

#include "integrators/radiosity/patches.h"
#include "integrators/radiosity/system.h"

namespace iride::radiosity {

// [vertex][wavelength] of [patch][wavelength]; linear in it, so a steep fall towards a border may pass below 0.
Spectra to_vertices(PatchMesh const& mesh, Spectra const& of_patches);

}  // namespace iride::radiosity
