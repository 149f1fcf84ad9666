// SPDX-License-Identifier: Apache-2.0
// How a surface emits: radiance L cos^e(angle against the normal) inside a cone, 0 outside. e = 0 and a cone of 90
// degrees is the diffuse emitter. [Warn 1983]
#pragma once

#include <cmath>

#include "base/constants.h"
#include "base/warp.h"
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
    // A direction about +z drawn with density share(cos) cos / exitance [1/sr].
    Direction sample(Sample2 u) const {
        if (is_diffuse()) return to_cosine_hemisphere(u);
        float const e = exponent + 2, end = std::pow(cosine_end, e);
        float const cosine = std::pow(1 - u.x * (1 - end), 1 / e);
        auto const [sine_turn, cosine_turn] = sine_cosine_of_turns(u.y);
        float const sine = std::sqrt(std::max(0.0f, (1 - cosine) * (1 + cosine)));
        return {sine * cosine_turn, sine * sine_turn, cosine};
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
