// SPDX-License-Identifier: Apache-2.0
// Metals, bare or coated, whose reflectance F at a plane is a model's parameter: a mirror, or GGX microfacets.
//   f = F(<wi, h>) D(h) G2(wo, wi) / (4 cos wo cos wi),      h = (wo + wi) / |wo + wi|
// Visible normals are sampled, so p(wi) = G1(wo) D(h) / (4 cos wo) and weight = F G2 / G1 <= 1. Which directions are
// drawn does not depend on the wavelength: reach = 1. Single scattering between the facets. [Walter 2007]
#pragma once

#include "materials/bsdf.h"
#include "materials/coating.h"
#include "materials/fresnel.h"
#include "materials/microfacet.h"

namespace iride {

// The Fresnel term of a bare metal in air.
struct BareFresnel {
    Lanes n, k;
    Lanes operator()(float cosine) const { return fresnel_unpolarised(cosine, n, k); }
};

template <class Fresnel>
struct SmoothMetal {
    static constexpr bool has_density = false;
    Fresnel fresnel;

    BsdfEvaluation evaluate(Direction const&, Direction const&) const { return {}; }

    std::optional<BsdfSample> sample(Direction const& wo, Sample3) const {
        if (wo.z() <= 0) return std::nullopt;
        return std::optional<BsdfSample>(std::in_place, Direction(-wo.x(), -wo.y(), wo.z()), fresnel(wo.z()), Lanes(1),
                                         std::nullopt);
    }
};

template <class Fresnel>
struct RoughMetal {
    static constexpr bool has_density = true;
    Fresnel fresnel;
    Ggx ggx;

    BsdfEvaluation evaluate(Direction const& wo, Direction const& wi) const {
        if (wo.z() <= 0 || wi.z() <= 0) return {};
        Direction const h = (wo + wi).normalized();
        float const lambda_o = ggx.lambda(wo), lambda_i = ggx.lambda(wi);
        float const common = ggx.distribution(h).value / (4 * wo.z());  // shared by value and density
        Lanes const F = fresnel(std::min(1.0f, wi.dot(h)));
        return {BsdfValue((F * (common / ((1 + lambda_o + lambda_i) * wi.z()))).lane),
                LaneDensity(common / (1 + lambda_o))};
    }

    std::optional<BsdfSample> sample(Direction const& wo, Sample3 u) const {
        if (wo.z() <= 0) return std::nullopt;
        Direction const h = ggx.visible_normal(wo, u.direction);
        float const cosine = std::min(1.0f, wo.dot(h));
        Direction const wi = (2 * cosine * h - wo).normalized();
        if (wi.z() <= 0) return std::nullopt;  // shadowed for good: single scattering loses it
        float const lambda_o = ggx.lambda(wo), lambda_i = ggx.lambda(wi);
        PerSteradian const density(ggx.distribution(h).value / (4 * wo.z() * (1 + lambda_o)));
        Lanes const F = fresnel(cosine);
        return std::optional<BsdfSample>(std::in_place, wi, F * ((1 + lambda_o) / (1 + lambda_o + lambda_i)), Lanes(1),
                                         density);
    }
};

using SmoothConductor = SmoothMetal<BareFresnel>;
using RoughConductor = RoughMetal<BareFresnel>;
using SmoothCoatedConductor = SmoothMetal<CoatedFresnel>;
using RoughCoatedConductor = RoughMetal<CoatedFresnel>;

}  // namespace iride
