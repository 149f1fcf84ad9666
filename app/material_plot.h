// SPDX-License-Identifier: Apache-2.0
// The page of `iride material --plot`: reflectance against wavelength for each angle, the colour from 0 to 90 degrees
// as a polar strip, and how far approximations are off, in x, y and as CIEDE2000.
#pragma once

#include "app/material_colour.h"

namespace iride {

// Throws InputError if the file cannot be written.
void plot_material(GivenMaterial const& material, MaterialColorimetry const& colorimetry,
                   std::vector<double> const& angles_deg, std::string const& illuminant, std::string const& file);

}  // namespace iride
