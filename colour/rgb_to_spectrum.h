// SPDX-License-Identifier: Apache-2.0
// RGB as a spectrum, by three fixed basis functions B_k with sum 1, each in [0, 1] and as smooth as possible, such that
//   sum_k c_k B_k  under D65 has exactly the linear Rec.709 colour c.          [Mallett 2019]
// "Exactly": relative to the light, XYZ over the XYZ of tabulated D65 is XYZ over the XYZ of the published white, so
// that (1, 1, 1) is the perfect reflector. Linear, so pictures may be interpolated as RGB; a reflectance of a colour in
// the Rec.709 gamut stays within [0, 1].
#pragma once

#include <array>

#include "colour/rgb_space.h"
#include "spectral/spectral_function.h"

namespace iride {

// The three basis functions, 360..830 nm in steps of 5 nm; solved once per program from the observer and D65 by
// minimising the squared second differences under the equalities, with the bounds enforced by an active set.
std::array<SpectralFunction, 3> const& rec709_basis();

// D65 with the luminance-weighted radiance 1: what an emission of RGB (1,1,1) is multiplied by.
SpectralFunction const& unit_d65();

enum class RgbRole { reflectance, emission };

// The spectrum of an RGB colour of `space`. Throws InputError (without location: the caller adds it) when the colour is
// outside the Rec.709 gamut (a component below -1e-6, or for a reflectance above 1 + 1e-6). An emission is the product
// with D65 tabulated at 1 nm: its XYZ is off by less than 5e-6 of the white's Y.
SpectralFunction rgb_to_spectrum(Eigen::Vector3d const& rgb, RgbSpace const& space, RgbRole role);

}  // namespace iride
