// SPDX-License-Identifier: Apache-2.0
// Additive mixture: complementary colours and the proportions in which they give white. Amounts of a mixture act on the
// sums X + Y + Z: x_mix = (m_a x_a + m_b x_b) / (m_a + m_b), with m = Y / y. [CIE 15:2018, 9]
#pragma once

#include <optional>

#include "colour/spectral_locus.h"

namespace iride {

// Shares of the luminance that two lights contribute to their mixture; first + second = 1.
struct LuminanceShares {
    double first, second;
};

// How to mix `target` from two lights, or nothing where it does not lie between them (to 1e-9 in x, y).
std::optional<LuminanceShares> mixing_to(Chromaticity const& target, Chromaticity const& first,
                                         Chromaticity const& second);

// The monochromatic light that mixes with one at `wavelength_nm` to the white, and in what shares of luminance.
struct Complementary {
    double wavelength_nm;
    LuminanceShares shares;  // first: of the light asked for, second: of its complement
};
// Absent for the greens, whose complement is a purple. Throws InputError outside the locus's wavelengths.
std::optional<Complementary> complementary(double wavelength_nm, Chromaticity const& white, Observer const& observer,
                                           SpectralLocus const& locus);

}  // namespace iride
