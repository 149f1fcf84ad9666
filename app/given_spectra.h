// SPDX-License-Identifier: Apache-2.0
// Spectra as a command's arguments name them: of the catalogue, a group of it, a file with one or many columns,
// "blackbody:2700", "daylight:5200".
#pragma once

#include <string>
#include <vector>

#include "spectral/spectral_function.h"

namespace iride {

struct GivenSpectrum {
    SpectralFunction function;
    bool is_light;         // else a reflectance factor or a transmittance
    std::string quantity;  // "power", "reflectance", "transmittance", "reflectance at normal incidence" of an n + ik
};

// What the data say they hold decides, or `quantity` if it is not empty; where neither does, .spd is a light and
// anything else a reflectance. Throws InputError: unknown name, bad file, an index of refraction not known in the
// visible, unknown quantity.
std::vector<GivenSpectrum> given_spectra(std::vector<std::string> const& names, std::string const& quantity = {});

}  // namespace iride
