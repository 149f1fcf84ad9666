// SPDX-License-Identifier: Apache-2.0
// The bundle of rays that a path stands for, as a cone about its ray: what of a texture one look-up may average.
//   diameter at distance t = width + spread t                                                     [Amanatides 1984]
// Approximated: curved mirrors and refraction leave the spread as it is; a scattering of density p opens the cone by a
// quarter of the lobe's own width, 2 / sqrt(pi p), so that an average over the lobe stays sharper than the lobe.
#pragma once

#include <cmath>

#include "base/quantity.h"

namespace iride {

struct RayCone {
    float width = 0;   // diameter at the ray's origin [m]
    float spread = 0;  // growth per metre [rad]

    float width_at(float distance) const { return width + spread * distance; }

    // After a scattering at `distance` along the ray, of density p_hero if it was no Dirac lobe.
    RayCone scattered(float distance, PerSteradian const* density) const {
        constexpr float share_of_lobe = 0.25f, widest = 0.5f;  // rad: the tangent plane is no plane any more
        float const opening = density ? share_of_lobe * 2 / std::sqrt(pi * std::max(density->value, 1e-6f)) : 0;
        return {width_at(distance), std::min(widest, std::hypot(spread, opening))};
    }
};

}  // namespace iride
