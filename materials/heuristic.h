// SPDX-License-Identifier: Apache-2.0
// The heuristic models of the literature of the seventies, for comparison and teaching: a cosine power beside a
// constant.
//   Phong               f = k_s <r, wo>^e / <n, wi> + k_d,   r: the mirror direction of wi          [Phong 1975]
//   BlinnPhong          f = k_s <n, h>^e / <n, wi> + k_d,    h = (wo + wi) / |wo + wi|              [Blinn 1977]
//   ModifiedBlinnPhong  f = k_s <n, h>^e + k_d
// Their defects are theirs and kept: the first two are not reciprocal, and the share of the light from wi that they
// give back passes 1 near grazing for every k_s > 0; none has Fresnel's equations. k_s and k_d may be anything >= 0.
// Sampled by their own lobe, or by the cosine, in proportion to means over the lanes: reach = 1, density exact.
#pragma once

#include <cmath>

#include "base/warp.h"
#include "materials/bsdf.h"

namespace iride {

enum class HeuristicLobe { phong, blinn_phong, modified_blinn_phong };

// What the lobe with k_s = 1 gives back of light along the normal [sr]: 2 pi / (e + 2) for Phong's, else
// 8 pi (2^(-e/2) + e) / ((e + 2) (e + 4)).
inline double lobe_albedo(HeuristicLobe lobe, double e) {
    if (lobe == HeuristicLobe::phong) return 2 * pi_double / (e + 2);
    return 8 * pi_double * (std::exp2(-e / 2) + e) / ((e + 2) * (e + 4));
}

template <HeuristicLobe lobe>
struct Heuristic {
    static constexpr bool has_density = true;
    Lanes diffuse, specular;  // k_d, k_s [1/sr]
    float exponent;

    BsdfEvaluation evaluate(Direction const& wo, Direction const& wi) const {
        float const share = share_of_lobe();
        if (!(wo.z() > 0 && wi.z() > 0) || share < 0) return {};
        return evaluate(wo, share, wi);
    }

    std::optional<BsdfSample> sample(Direction const& wo, Sample3 u) const {
        float const share = share_of_lobe();
        if (!(wo.z() > 0) || share < 0) return std::nullopt;
        Direction const wi = u.lobe < share ? along_lobe(wo, u.direction) : to_cosine_hemisphere(u.direction);
        if (!(wi.z() > 0)) return std::nullopt;  // the part of the lobe below the surface
        BsdfEvaluation const e = evaluate(wo, share, wi);
        PerSteradian const density(e.density[0]);
        if (!(density.value > 0)) return std::nullopt;
        return std::optional<BsdfSample>(std::in_place, wi, Throughput(e.value.lane * (wi.z() / density.value)),
                                         Lanes(1), density);
    }

  private:
    static constexpr bool about_mirror = lobe == HeuristicLobe::phong;
    static constexpr float least_cosine = 1e-9f;  // keeps 1 / cos wi finite; the product with cos wi is what counts

    // The probability of the lobe, negative if the surface is black.
    float share_of_lobe() const {
        float const s = sum(specular).value * (about_mirror ? 1 : 4) / (exponent + 1), d = sum(diffuse).value / 2;
        return s + d > 0 ? s / (s + d) : -1;
    }

    // The cosine power of the lobe, from 1 - cosine, which keeps its digits where the lobe is narrow.
    float power(Direction const& wo, Direction const& wi) const {
        float below;
        if constexpr (about_mirror) {
            below = (square(wi.x() + wo.x()) + square(wi.y() + wo.y()) + square(wi.z() - wo.z())) / 2;
            if (below >= 1) return 0;
        } else {
            Direction const h = (wo + wi).normalized();
            below = (square(h.x()) + square(h.y())) / (1 + h.z());
        }
        return std::exp(exponent * std::log1p(-std::min(below, one_minus_epsilon)));
    }

    BsdfEvaluation evaluate(Direction const& wo, float share, Direction const& wi) const {
        float const lobe_value = power(wo, wi);
        float density = (exponent + 1) * (inverse_pi / 2) * lobe_value;
        if constexpr (!about_mirror) density /= 2 * std::max(least_cosine, (wo + wi).norm());  // 4 <wo, h>
        float const value =
            lobe == HeuristicLobe::modified_blinn_phong ? lobe_value : lobe_value / std::max(least_cosine, wi.z());
        return {BsdfValue((specular * value + diffuse).lane),
                LaneDensity(share * density + (1 - share) * cosine_hemisphere_density(wi.z()).value)};
    }

    // wi about the mirror direction of wo, or by h about the normal: cosine c of density (e + 1) c^e.
    Direction along_lobe(Direction const& wo, Sample2 u) const {
        // 1 - c of c = (1 - u)^(1 / (e + 1)).
        float const below = -std::expm1(std::log1p(-u.x) / (exponent + 1));
        float const r = std::sqrt(std::max(0.0f, below * (2 - below)));
        auto const [sine, cosine] = sine_cosine_of_turns(u.y);
        Direction const about_axis(r * cosine, r * sine, 1 - below);
        if constexpr (about_mirror) return Frame::around(Direction(-wo.x(), -wo.y(), wo.z())).to_world(about_axis);
        return (2 * wo.dot(about_axis) * about_axis - wo).normalized();
    }
};

using Phong = Heuristic<HeuristicLobe::phong>;
using BlinnPhong = Heuristic<HeuristicLobe::blinn_phong>;
using ModifiedBlinnPhong = Heuristic<HeuristicLobe::modified_blinn_phong>;

}  // namespace iride
