// SPDX-License-Identifier: Apache-2.0
// Many RGB reflectances at once: the sigmoids of colour/sigmoid_fit.h, found from a table of them over the RGB cube and
// improved by the same damped Newton steps until the CIE 1976 difference is below .01 (tested: .02, by another
// quadrature); one exact fit takes about 10 us, one from the table 1.3, and a colour that no reflectance has, 100: the
// nearest that one fit finds, not the 81 of SigmoidFitter::nearest, whatever a picture holds.
// Table: for each component that may be the largest, m in 32 steps and the two others over m in 16 each; made on all
// processors when a picture first needs it, once for each RGB space. [Jakob 2019, section 4]
#pragma once

#include <array>
#include <span>
#include <vector>

#include "colour/rgb_space.h"

namespace iride {

struct UpliftedColours {
    std::vector<std::array<float, 3>> sigmoid;  // a, b, c of SigmoidShape
    std::size_t unreachable = 0;                // colours that no smooth reflectance has: these got the nearest found
    double worst_difference = 0;                // CIE 1976, among those
};

// The reflectances of linear RGB colours of `space` under its white. Black, white and greys are constants exactly.
UpliftedColours uplift_reflectances(std::span<Eigen::Array3f const> rgb, RgbSpace const& space);

}  // namespace iride
