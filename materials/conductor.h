// SPDX-License-Identifier: Apache-2.0
// Metals, bare or coated, whose reflectance F at a plane is a model's parameter: a mirror, or microfacets.
//   f = F(<wi, h>) D(h) G2(wo, wi, h) / (4 cos wo cos wi) + F_ms m(wo, wi),      h = (wo + wi) / |wo + wi|
// The second term is what several bounces between the facets bring back, with the losses of FacetLoss:
//   m = loss(wo) loss(wi) / (pi mean_loss),  F_ms = F_avg^2 E_avg / (1 - F_avg (1 - E_avg)),  E_avg = 1 - mean_loss,
// F_avg = 2 int F(mu) mu dmu. Exact: the energy for F = 1 (what is lost comes back, up to the table's error) and
// reciprocity. Approximate: the shape of m, and that each further bounce sees the mean F and E: the albedo of gold
// comes within .025 of a random walk over the facets (tested).      [Walter 2007] [Kulla 2017]
#pragma once

#include "materials/bsdf.h"
#include "materials/coating.h"
#include "materials/facet_loss.h"
#include "materials/fresnel.h"

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

// The density is f for F = 1, times cos wi: a visible normal is kept with probability G2 / G1, else wi is drawn from m,
// so that weight <= 1. Which directions are drawn does not depend on the wavelength: reach = 1.
template <class Fresnel, FacetModel FacetType>
struct RoughMetal {
    static constexpr bool has_density = true;
    Fresnel fresnel;
    FacetType facets;
    FacetLoss const* loss = nullptr;  // of the same facets; outlives this. Null: single scattering, the rest is lost
    Lanes multiple_fresnel{};         // F_ms

    BsdfEvaluation evaluate(Direction const& wo, Direction const& wi) const {
        if (wo.z() <= edge_on || wi.z() <= edge_on) return {};
        Direction const h = unit(wo + wi);
        Parts const p = parts(wo, wi, h, facets.lambda(wo, h), facets.lambda(wi, h));
        Lanes const F = fresnel(std::min(1.0f, wi.dot(h)));
        return {BsdfValue((F * p.once + multiple_fresnel * p.often).lane), LaneDensity((p.once + p.often) * wi.z())};
    }

    std::optional<BsdfSample> sample(Direction const& wo, Sample3 u) const {
        if (wo.z() <= edge_on) return std::nullopt;
        Sample3 rest = u;
        Direction h = facets.visible_normal(wo, rest);
        Direction wi = unit(2 * wo.dot(h) * h - wo);
        float lambda_o = facets.lambda(wo, h), lambda_i = facets.lambda(wi, h);
        float const kept = wi.z() > edge_on ? (1 + lambda_o) / (1 + facets.joint(lambda_o, lambda_i)) : 0;
        if (rest.lobe >= kept) {
            if (!loss) return std::nullopt;
            wi = loss->sample({(rest.lobe - kept) / (1 - kept), further_numbers(u).x});
            if (wi.z() <= edge_on) return std::nullopt;
            h = unit(wo + wi);
            lambda_o = facets.lambda(wo, h), lambda_i = facets.lambda(wi, h);
        }
        Parts const p = parts(wo, wi, h, lambda_o, lambda_i);
        float const white = p.once + p.often;
        if (!(white > 0)) return std::nullopt;  // D and what is lost below the range of floats
        Lanes const F = fresnel(std::min(1.0f, wo.dot(h)));
        return std::optional<BsdfSample>(std::in_place, wi, F * (p.once / white) + multiple_fresnel * (p.often / white),
                                         Lanes(1), PerSteradian(white * wi.z()));
    }

  private:
    struct Parts {
        float once, often;  // f of one and of several bounces for F = 1 [1/sr]
    };
    Parts parts(Direction const& wo, Direction const& wi, Direction const& h, float lambda_o, float lambda_i) const {
        return {facets.distribution(h).value / (4 * wo.z() * wi.z() * (1 + facets.joint(lambda_o, lambda_i))),
                loss ? loss->loss(wo) * loss->loss(wi) / (pi * loss->mean()) : 0};
    }
};

// F_ms of the model above. [dimensionless]
inline double multiple_scattering_fresnel(double mean_fresnel, double mean_loss) {
    return mean_fresnel * mean_fresnel * (1 - mean_loss) / (1 - mean_fresnel * mean_loss);
}

using SmoothConductor = SmoothMetal<BareFresnel>;
using SmoothCoatedConductor = SmoothMetal<CoatedFresnel>;
using RoughConductor = RoughMetal<BareFresnel, Ggx>;
using RoughCoatedConductor = RoughMetal<CoatedFresnel, Ggx>;

}  // namespace iride
