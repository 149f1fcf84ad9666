// SPDX-License-Identifier: Apache-2.0
// How a surface emits: radiance L cos^e(angle against the normal) inside a cone, 0 outside. e = 0 and a cone of 90
// degrees is the diffuse emitter. [Warn 1983]
#pragma once

#include <cmath>

#include "base/constants.h"
#include "spectral/spectrum.h"

namespace iride {

struct EmissionProfile {
    float exponent = 0;    // e >= 0
    float cosine_end = 0;  // of the cone's half angle

    bool is_diffuse() const { return exponent == 0 && cosine_end == 0; }
    // The share of L at that cosine; 0 behind the surface.
    float share(float cosine) const {
        if (!(cosine > cosine_end)) return 0;
        return exponent == 0 ? 1 : std::pow(cosine, exponent);
    }
    // Exitance over L: int share(cos) cos = 2 pi (1 - cosine_end^(e + 2)) / (e + 2) [sr].
    double exitance() const {
        double const e = static_cast<double>(exponent) + 2;
        return 2 * pi_double * (1 - std::pow(static_cast<double>(cosine_end), e)) / e;
    }
};

// An emitting surface, on its front or on both sides.
struct Emitter {
    Emission radiance;  // L
    bool two_sided = false;
    EmissionProfile profile = {};

    // `cosine` is negative behind the surface.
    float share(float cosine) const { return profile.share(two_sided ? std::abs(cosine) : cosine); }
};

}  // namespace iride
