// SPDX-License-Identifier: Apache-2.0
// RGB as a spectrum. A reflectance is a smooth sigmoid (colour/sigmoid_fit.h) that has the colour under the space's own
// white; the others are built from it:
//   reflectance   S(c),  0 <= S <= 1
//   unbounded     s S(c / s),  s = 2 max c (or 4, 8, .. 32 max c, for a colour too saturated to reflect that much)
//   emission      unbounded times the white as a light
// "Has the colour": relative to the light, XYZ over the XYZ of the light's spectrum is XYZ over the XYZ of the
// published white. So (1, 1, 1) is exactly the perfect reflector, exactly 1, exactly the white's spectrum; a grey is a
// constant. Error: CIE 1976 difference below .002 over the sRGB cube, as the 1931 observer sees it. Beyond 360..830 nm,
// where no RGB says anything, the sigmoid goes on (Outside::extrapolate), and an emission ends where the light's table
// does.
#pragma once

#include "colour/rgb_space.h"
#include "spectral/spectral_function.h"

namespace iride {

// D65 with the luminance-weighted radiance 1: what an emission of RGB (1,1,1) is multiplied by.
SpectralFunction const& unit_d65();

// The light whose chromaticity is `white`, of luminance 1: tabulated D65 for the white of sRGB, Rec.2020 and Display
// P3; otherwise, as for ACES, S0 + M1 S1 + M2 S2 of the CIE daylight basis with M1 and M2 such that its chromaticity is
// `white` exactly, 300..830 nm. Throws InputError if that is negative anywhere. [CIE 15:2018, 4.1.2]
SpectralFunction const& white_light(Chromaticity const& white);

enum class RgbRole { reflectance, unbounded, emission };

// The spectrum of a linear RGB colour of `space`. Throws InputError (without location: the caller adds it) when the
// colour is not finite, or no smooth reflectance has it to within a CIE 1976 difference of .001: it then tells the
// nearest colour found in that metric, and the difference (for emissions, at half the white's brightness).
SpectralFunction rgb_to_spectrum(Eigen::Vector3d const& rgb, RgbSpace const& space, RgbRole role);

}  // namespace iride
