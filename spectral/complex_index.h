// SPDX-License-Identifier: Apache-2.0
// Complex index of refraction n + ik as a function of wavelength. A wave decays as exp(-2 pi k z / lambda).
#pragma once

#include "spectral/spectral_function.h"

namespace iride {

struct ComplexIndex {
    SpectralFunction n = SpectralFunction::constant(1);
    SpectralFunction k = SpectralFunction::constant(0);
};

}  // namespace iride
