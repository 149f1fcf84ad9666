// SPDX-License-Identifier: Apache-2.0
// A dielectric coat of index n over a Lambertian base of reflectance rho. With R(w) the coat's reflectance from outside
// and T(w) = (1 - R) exp(-a / cos t) what reaches the base (a: optical depth of the coat, t: angle inside),
//   f = reflection by the coat + T(wo) T(wi) / (pi n^2) rho / (1 - rho R_i)
// R_i is what of the base's light the coat sends back to it; the quotient sums all orders. Light from a Lambertian base
// arrives at the coat from everywhere alike, so the formula is exact, for a rough coat too. [Saunderson 1942]
//   SmoothPlastic   R is Fresnel's, and a mirror image lies beside the diffuse lobe
//   RoughPlastic    R is the albedo of a GGX coat (coat_albedo.h), single scattering: what a facet throws at another is
//                   taken to enter. Absorption as under a smooth coat.
// Which lobe is sampled depends on means over the lanes: reach = 1.
#pragma once

#include "materials/bsdf.h"
#include "materials/coat_albedo.h"
#include "materials/fresnel.h"

namespace iride {

// rho / (n^2 (1 - rho R_i)).
inline Lanes radiance_inside(Lanes const& rho, Lanes const& n, Lanes const& internal) {
    return rho / (n * n * (Lanes(1) - rho * internal));
}

// The diffuse part of both.
struct CoatedBase {
    Lanes n;
    Lanes depth;     // a
    Lanes base;      // radiance_inside
    float entering;  // about 2 int T(mu) mu dmu, for the choice of lobe

    // T, of the reflectance at that cosine.
    Lanes transmittance(Lanes const& reflectance, float cosine) const {
        Lanes T = Lanes(1) - reflectance;
        if (is_black(depth)) return T;
        float const sine2 = (1 - cosine) * (1 + cosine);
        for (int i = 0; i < lane_count; ++i)
            T.lane[i] *= std::exp(-depth.lane[i] / std::sqrt(1 - std::min(sine2 / square(n.lane[i]), largest_sine2)));
        return T;
    }
    // The probability of the coat's own reflection, by the albedos of both lobes.
    float share_of_coat(Lanes const& reflectance, Lanes const& T) const {
        float const coat = sum(reflectance), diffuse = sum(T * base) * entering;
        return coat > 0 ? coat / (coat + diffuse) : 0;
    }

  private:
    static constexpr float largest_sine2 = 0.999999f;  // for n = 1 at grazing: keeps the path inside finite
};

struct SmoothPlastic {
    static constexpr bool has_density = true;
    CoatedBase coat;

    BsdfEvaluation evaluate(Direction const& wo, Direction const& wi) const {
        if (!(wo.z() > edge_on && wi.z() > edge_on)) return {};
        Lanes const R = reflectance(wo.z()), T = coat.transmittance(R, wo.z());
        return evaluate(T, coat.share_of_coat(R, T), wi);
    }

    std::optional<BsdfSample> sample(Direction const& wo, Sample3 u) const {
        if (!(wo.z() > edge_on)) return std::nullopt;
        Lanes const R = reflectance(wo.z()), T = coat.transmittance(R, wo.z());
        float const share = coat.share_of_coat(R, T);
        if (u.lobe < share)
            return std::optional<BsdfSample>(std::in_place, Direction(-wo.x(), -wo.y(), wo.z()), R * (1 / share),
                                             Lanes(1), std::nullopt);
        Direction const wi = to_cosine_hemisphere(u.direction);
        if (!(wi.z() > edge_on)) return std::nullopt;  // the rim of the disc: probability 0
        BsdfEvaluation const e = evaluate(T, share, wi);
        PerSteradian const density(e.density[0]);
        return std::optional<BsdfSample>(std::in_place, wi, Throughput(e.value.lane * (wi.z() / density.value)),
                                         Lanes(1), density);
    }

  private:
    Lanes reflectance(float cosine) const { return fresnel_unpolarised(std::min(1.0f, cosine), coat.n, Lanes(0)); }
    BsdfEvaluation evaluate(Lanes const& T, float share, Direction const& wi) const {
        Lanes const through = T * coat.transmittance(reflectance(wi.z()), wi.z());
        return {BsdfValue((through * coat.base * inverse_pi).lane),
                LaneDensity((1 - share) * cosine_hemisphere_density(wi.z()).value)};
    }
};

struct RoughPlastic {
    static constexpr bool has_density = true;
    [[no_unique_address]] CoatedBase coat;  // what follows fills its last register
    Ggx ggx;
    CoatAlbedo const* albedo;  // of the same ggx; of the material, which outlives every path

    BsdfEvaluation evaluate(Direction const& wo, Direction const& wi) const {
        if (!(wo.z() > edge_on && wi.z() > edge_on)) return {};
        Lanes const R = albedo->reflectance(coat.n, wo.z()), T = coat.transmittance(R, wo.z());
        return evaluate(wo, T, coat.share_of_coat(R, T), wi);
    }

    std::optional<BsdfSample> sample(Direction const& wo, Sample3 u) const {
        if (!(wo.z() > edge_on)) return std::nullopt;
        Lanes const R = albedo->reflectance(coat.n, wo.z()), T = coat.transmittance(R, wo.z());
        float const share = coat.share_of_coat(R, T);
        Direction wi;
        if (u.lobe < share) {
            Direction const h = ggx.visible_normal(wo, u);
            wi = (2 * wo.dot(h) * h - wo).normalized();
        } else {
            wi = to_cosine_hemisphere(u.direction);
        }
        if (!(wi.z() > edge_on)) return std::nullopt;  // thrown down by a steep facet
        BsdfEvaluation const e = evaluate(wo, T, share, wi);
        PerSteradian const density(e.density[0]);
        return std::optional<BsdfSample>(std::in_place, wi, Throughput(e.value.lane * (wi.z() / density.value)),
                                         Lanes(1), density);
    }

  private:
    BsdfEvaluation evaluate(Direction const& wo, Lanes const& T, float share, Direction const& wi) const {
        Direction const h = (wo + wi).normalized();
        float const lambda_o = ggx.lambda(wo), lambda_i = ggx.lambda(wi);
        float const common = ggx.distribution(h).value / (4 * wo.z());
        Lanes const F = fresnel_unpolarised(std::min(1.0f, wi.dot(h)), coat.n, Lanes(0));
        Lanes const through = T * coat.transmittance(albedo->reflectance(coat.n, wi.z()), wi.z());
        return {
            BsdfValue((F * (common / ((1 + lambda_o + lambda_i) * wi.z())) + through * coat.base * inverse_pi).lane),
            LaneDensity(share * common / (1 + lambda_o) + (1 - share) * cosine_hemisphere_density(wi.z()).value)};
    }
};

}  // namespace iride
