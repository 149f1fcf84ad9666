// SPDX-License-Identifier: Apache-2.0
// What the patches of a scene reflect and emit. What is not diffuse is taken for a diffuse surface of the same albedo
// under even light; light from lamps without extent and from the environment enters as what it makes a patch reflect
// once. What is left out or approximated is said.
#pragma once

#include <string>
#include <vector>

#include "integrators/radiosity/patches.h"
#include "integrators/radiosity/system.h"

namespace iride::radiosity {

// Area, reflectance and emission of each patch at wavelengths given. `mirrors`: they are followed by rays (mirrors.h),
// and reflect nothing here.
System patch_spectra(Scene const& scene, PatchMesh const& mesh, PatchTracer const& tracer,
                     std::vector<double> const& wavelengths_nm, bool mirrors = false);

// The wavelengths from the `first` on that fill a packet; the last is repeated.
Wavelengths packet_of(std::vector<double> const& wavelengths_nm, std::size_t first, WavelengthGrid const& grid);

// "patch 12 of shape 3 (material 'white')"
std::string describe(Scene const& scene, PatchMesh const& mesh, std::size_t patch);

// Materials that are no diffuse surfaces, patches that lie on one another, slivers left out.
std::vector<std::string> approximations(Scene const& scene, PatchMesh const& mesh, bool mirrors = false);

}  // namespace iride::radiosity
