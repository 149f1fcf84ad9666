// SPDX-License-Identifier: Apache-2.0
// A config's colour spaces against what their names promise (reference_space.h): numbers in OpenColorIO's float, from
// the role aces_interchange, or cie_xyz_d65_interchange for what a display shows, against the formulas in double.
#pragma once

#include <string>
#include <vector>

#include "colour/colour_config.h"

namespace iride {

struct SpaceCheck {
    std::string name, recognised_as;
    // Largest error of a number, over colours up to the white and 2^-10 of it at least: in the space's own numbers.
    double max_error, tolerance;
    double white_error;                  // of the reference white, likewise
    double delta_e_2000_max;             // what the numbers mean against what was given, CIEDE2000
    double round_trip_delta_e_2000_max;  // there and back by the config alone
    std::string negative;                // linear values below 0: "kept" there and back, "clamped", "not finite"
    std::string nan;                     // a NaN given: "kept" or "lost"
    std::string failure;                 // why the config has no way there and back; empty if it has
    bool ok;                             // errors within `tolerance`, differences below tolerable_delta_e, all finite
};

struct UncheckedSpace {
    std::string name, reason;
};

struct ConfigCheck {
    std::vector<SpaceCheck> spaces;
    std::vector<UncheckedSpace> unchecked;
    bool ok;  // every space is, and there is one besides the reference itself
};

// A fiftieth of what an eye notices; exact spaces in float stay below a tenth of it but for OpenColorIO's tables.
inline constexpr double tolerable_delta_e = 0.002;

// Throws InputError if the config has no role aces_interchange.
ConfigCheck check_config(ColourConfig const& config);

}  // namespace iride
