// SPDX-License-Identifier: Apache-2.0
// A solved scene as a PLY file, binary, little endian, which other programs show: vertices with position, XYZ of their
// radiance (as the film scales it), an 8-bit sRGB of that, and the full spectrum as floats radiosity_0 ..; faces with
// their corners, shape, side and the face on the other side. Comments name the scene's hash and the wavelengths.
#pragma once

#include <filesystem>
#include <memory>

#include "integrators/radiosity/field.h"

namespace iride::radiosity {

// Throws InputError if the file cannot be written.
void save_solution(std::filesystem::path const& path, Scene const& scene, RadiosityField const& field);

// Throws InputError: no such file, damaged, or of another scene (or another version of this one).
std::shared_ptr<RadiosityField const> load_solution(std::filesystem::path const& path, Scene const& scene);

}  // namespace iride::radiosity
