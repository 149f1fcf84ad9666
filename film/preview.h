// SPDX-License-Identifier: Apache-2.0
// A PNG preview of a film through an OpenColorIO view. Written whole or not at all.
#pragma once

#include <filesystem>

#include "colour/colour_config.h"
#include "film/exr.h"

namespace iride {

// 8 bits per channel, rounded to nearest, clamped to 0..1 after the view; a NaN pixel becomes magenta.
void write_preview(Film const& film, Chromaticity const& scene_white, double exposure, ColourTransform const& display,
                   std::filesystem::path const& path);

}  // namespace iride
