// SPDX-License-Identifier: Apache-2.0
// Light pictures as spectra, by three fixed basis functions B_k with sum 1, each in [0, 1] and as smooth as possible,
// such that  sum_k c_k B_k  under D65 has exactly the linear Rec.709 colour c.         [Mallett 2019] "Exactly":
// relative to the light, XYZ over the XYZ of tabulated D65 is XYZ over the XYZ of the published white, so that (1, 1,
// 1) is D65 itself. Linear in c: filtering a picture and filtering its spectra are the same.
#pragma once

#include <array>

#include "spectral/spectral_function.h"

namespace iride {

// The three basis functions, 360..830 nm in steps of 5 nm; solved once per program from the observer and D65 by
// minimising the squared second differences under the equalities, with the bounds enforced by an active set.
std::array<SpectralFunction, 3> const& rec709_basis();

}  // namespace iride
