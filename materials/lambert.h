// SPDX-License-Identifier: Apache-2.0
// Lambert's law: f = rho / pi, sampled by the cosine, so that weight = rho. [Lambert 1760]
#pragma once

#include "base/warp.h"
#include "materials/bsdf.h"

namespace iride {

struct Lambert {
    static constexpr bool has_density = true;
    Lanes reflectance;

    BsdfEvaluation evaluate(Direction const& wo, Direction const& wi) const {
        if (wo.z() <= 0 || wi.z() <= 0) return {};
        return {BsdfValue(reflectance.lane * inverse_pi), LaneDensity(cosine_hemisphere_density(wi.z()).value)};
    }

    std::optional<BsdfSample> sample(Direction const& wo, Sample3 u) const {
        if (wo.z() <= 0) return std::nullopt;
        Direction const wi = to_cosine_hemisphere(u.direction);
        if (wi.z() <= 0) return std::nullopt;  // the rim of the disc: probability 0
        return std::optional<BsdfSample>(std::in_place, wi, reflectance, Lanes(1), cosine_hemisphere_density(wi.z()));
    }
};

// Absorbs everything.
struct Black {
    static constexpr bool has_density = false;
    BsdfEvaluation evaluate(Direction const&, Direction const&) const { return {}; }
    std::optional<BsdfSample> sample(Direction const&, Sample3) const { return std::nullopt; }
};

}  // namespace iride
