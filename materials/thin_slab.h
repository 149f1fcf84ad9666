// SPDX-License-Identifier: Apache-2.0
// A plane-parallel pane in air as one surface: what is reflected between its faces is summed, the light goes straight
// on. With F of a face and t = exp(-sigma_a d / cos theta_t) along one crossing, for each polarisation
//   R = F + F (1 - F)^2 t^2 / (1 - F^2 t^2),    T = (1 - F)^2 t / (1 - F^2 t^2),    sin theta_t = sin theta / n,
// and their means; no interference (panes are thicker than light is coherent). The choice of lobe is alike for all
// lanes: reach = 1.                                                                   [Born 1999, secs. 1.5 and 7.6]
#pragma once

#include "materials/bsdf.h"
#include "materials/fresnel.h"

namespace iride {

struct SlabPower {
    float R, T;
};
// One polarisation; F, t in [0, 1].
inline SlabPower slab_power(float F, float t) {
    float const echo = 1 - square(F * t);
    if (!(echo > 0)) return {1, 0};  // F = 1: nothing gets in
    float const T = square(1 - F) * t / echo;
    return {F + F * t * T, T};
}

struct ThinSlab {
    static constexpr bool has_density = false;
    Lanes n, depth;  // sigma_a d

    BsdfEvaluation evaluate(Direction const&, Direction const&) const { return {}; }

    // cosine in [0, 1].
    void power(float cosine, Lanes& R, Lanes& T) const {
        for (int i = 0; i < lane_count; ++i) {
            FresnelReflectance<float> const F = fresnel(cosine, n[i], 0.0f);
            float const sine2 = (1 - square(cosine)) / square(n[i]);
            float const t = sine2 < 1 ? std::exp(-depth[i] / std::sqrt(1 - sine2)) : 0;
            SlabPower const s = slab_power(F.s, t), p = slab_power(F.p, t);
            R.set(i, (s.R + p.R) / 2);
            T.set(i, (s.T + p.T) / 2);
        }
    }

    std::optional<BsdfSample> sample(Direction const& wo, Sample3 u) const {
        if (wo.z() == 0) return std::nullopt;
        Lanes R, T;
        power(std::min(1.0f, std::abs(wo.z())), R, T);
        float const reflected = sum(R), passed = sum(T), P = reflected / (reflected + passed);
        if (u.lobe < P)
            return std::optional<BsdfSample>(std::in_place, Direction(-wo.x(), -wo.y(), wo.z()), R * (1 / P), Lanes(1),
                                             std::nullopt);
        if (!(P < 1)) return std::nullopt;
        return std::optional<BsdfSample>(std::in_place, -wo, T * (1 / (1 - P)), Lanes(1), std::nullopt);
    }
};

}  // namespace iride
