// SPDX-License-Identifier: Apache-2.0
// The CIE spaces by name, as the command line calls them, each with its way from XYZ and back: XYZ xyY uvY Luv LCHuv
// Lab LCHab. XYZ is scaled so that the white has Y = 1; L* is 0 .. 100, hue in degrees.
#pragma once

#include <array>
#include <span>
#include <string>
#include <string_view>

#include "colour/xyz.h"

namespace iride {

struct CieSpace {
    using Triple = std::array<double, 3>;

    std::string_view name, summary;
    Triple (*from_xyz)(Xyz const& colour, Xyz const& white);
    Xyz (*to_xyz)(Triple const& colour, Xyz const& white);
};

// Every space, for listings; one by name, null if there is none of that name (it may be an RGB space).
std::span<CieSpace const> cie_spaces();
CieSpace const* find_cie_space(std::string_view name);

// XYZ of a triple that stands in `space`, refused where it is no colour: not finite, a chromaticity with y or v' = 0
// and Y > 0, negative XYZ (beyond rounding). Throws InputError with `place` (say, "line 3").
Xyz checked_xyz(CieSpace const& space, CieSpace::Triple const& colour, Xyz const& white, std::string const& place);

}  // namespace iride
