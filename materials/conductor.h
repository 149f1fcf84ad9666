// SPDX-License-Identifier: Apache-2.0
// Metals, bare or coated, whose reflectance F at a plane is a model's parameter: a mirror, or GGX microfacets.
//   f = F(<wi, h>) D(h) G2(wo, wi) / (4 cos wo cos wi),      h = (wo + wi) / |wo + wi|
// Visible normals are sampled, so p(wi) = G1(wo) D(h) / (4 cos wo) and weight = F G2 / G1 <= 1. Which directions are
// drawn does not depend on the wavelength: reach = 1. [Walter 2007]
//   RoughConductor            single scattering: light that meets a second facet is lost
//   InterreflectingConductor  with what returns after several facets
#pragma once

#include "materials/bsdf.h"
#include "materials/coating.h"
#include "materials/fresnel.h"
#include "materials/ggx_albedo.h"

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

// Several bounces between the facets: f + F_ms m, m = loss(wo) loss(wi) / (pi mean_loss) with the losses of GgxAlbedo,
//   F_ms = F_avg^2 E_avg / (1 - F_avg (1 - E_avg)), F_avg = 2 int F(mu) mu dmu.                            [Kulla 2017]
// Exact: the energy for F = 1 (what is lost comes back, up to the table's error) and reciprocity. Approximate: the
// shape of m, and that each further bounce sees the mean F and E: the albedo of gold comes within .025 of a random walk
// over the facets (tested). The density is f + m for F = 1, times cos wi: a visible normal is kept with probability G2
// / G1, else wi is drawn from m, so no sample is lost and weight <= 1.
struct InterreflectingConductor {
    static constexpr bool has_density = true;
    Lanes n, k;
    Lanes multiple_fresnel;  // F_ms
    Ggx ggx;
    GgxAlbedo const* albedo;  // of the same ggx; outlives this

    BsdfEvaluation evaluate(Direction const& wo, Direction const& wi) const {
        if (wo.z() <= 0 || wi.z() <= 0) return {};
        Direction const h = (wo + wi).normalized();
        Parts const p = parts(wo, wi, h, ggx.lambda(wo), ggx.lambda(wi));
        Lanes const F = fresnel_unpolarised(std::min(1.0f, wi.dot(h)), n, k);
        return {BsdfValue((F * p.once + multiple_fresnel * p.often).lane), LaneDensity((p.once + p.often) * wi.z())};
    }

    std::optional<BsdfSample> sample(Direction const& wo, Sample3 u) const {
        if (wo.z() <= 0) return std::nullopt;
        Direction h = ggx.visible_normal(wo, u.direction);
        Direction wi = (2 * wo.dot(h) * h - wo).normalized();
        float const lambda_o = ggx.lambda(wo);
        float lambda_i = ggx.lambda(wi);
        float const kept = wi.z() > 0 ? (1 + lambda_o) / (1 + lambda_o + lambda_i) : 0;
        if (u.lobe >= kept) {
            wi = around(albedo->sample_cosine((u.lobe - kept) / (1 - kept)), u.direction.x);
            if (wi.z() <= 0) return std::nullopt;  // probability 0
            h = (wo + wi).normalized();
            lambda_i = ggx.lambda(wi);
        }
        Parts const p = parts(wo, wi, h, lambda_o, lambda_i);
        float const white = p.once + p.often;
        Lanes const F = fresnel_unpolarised(std::min(1.0f, wo.dot(h)), n, k);
        return std::optional<BsdfSample>(std::in_place, wi, F * (p.once / white) + multiple_fresnel * (p.often / white),
                                         Lanes(1), PerSteradian(white * wi.z()));
    }

  private:
    struct Parts {
        float once, often;  // f of one and of several bounces for F = 1 [1/sr]
    };
    Parts parts(Direction const& wo, Direction const& wi, Direction const& h, float lambda_o, float lambda_i) const {
        return {ggx.distribution(h).value / (4 * wo.z() * wi.z() * (1 + lambda_o + lambda_i)),
                albedo->loss(wo.z()) * albedo->loss(wi.z()) / (pi * albedo->mean_loss())};
    }

    // The azimuth comes from the digits of u behind the first twelve bits: the visible normal depends on u smoothly, so
    // that those are still uniform when it was not kept (to better than 1e-6).
    static Direction around(float cosine, float u) {
        auto const [sine, cosine_of_azimuth] = sine_cosine_of_turns(u * 4096 - std::floor(u * 4096));
        float const r = std::sqrt(std::max(0.0f, (1 - cosine) * (1 + cosine)));
        return {r * cosine_of_azimuth, r * sine, cosine};
    }
};

// F_ms of the model above. [dimensionless]
inline double multiple_scattering_fresnel(double mean_fresnel, double mean_loss) {
    return mean_fresnel * mean_fresnel * (1 - mean_loss) / (1 - mean_fresnel * mean_loss);
}

}  // namespace iride
