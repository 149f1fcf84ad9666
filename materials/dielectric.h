// SPDX-License-Identifier: Apache-2.0
// A smooth boundary between two transparent media. With eta = n(side of wi) / n(side of wo) for the lane,
//   reflection:    probability F,      weight F / F_hero
//   transmission:  probability 1 - F,  sin(theta_i) = sin(theta_o) / eta (Snell), radiance scaled by 1 / eta^2, because
//                  L / n^2 is invariant along a refracted ray.      [Veach 1997, sec. 5.2]
// Lanes whose eta differs from the hero's refract elsewhere: their weight and reach are 0 in transmission; a reflection
// keeps them all, each with its own F. Beyond the critical angle F is exactly 1.
#pragma once

#include "materials/bsdf.h"
#include "materials/fresnel.h"

namespace iride {

struct SmoothDielectric {
    static constexpr bool has_density = false;
    Lanes inside, outside;  // n of the body (z < 0) and of what surrounds it (z > 0)

    BsdfEvaluation evaluate(Direction const&, Direction const&) const { return {}; }

    std::optional<BsdfSample> sample(Direction const& wo, Sample3 u) const {
        if (wo.z() == 0) return std::nullopt;
        bool const from_outside = wo.z() > 0;
        Lanes const eta = from_outside ? inside / outside : outside / inside;
        float const cosine = std::min(1.0f, std::abs(wo.z()));
        Lanes const F = fresnel_unpolarised(cosine, eta, Lanes(0));
        if (u.lobe < F[0]) {
            Lanes const ratio = F * (1 / F[0]);
            return std::optional<BsdfSample>(std::in_place, Direction(-wo.x(), -wo.y(), wo.z()), ratio, ratio,
                                             std::nullopt);
        }
        float const relative = 1 / eta[0];
        float const sine2 = (1 - square(cosine)) * square(relative);
        if (sine2 >= 1) return std::nullopt;  // F is 1 there: reached by rounding only
        float const cosine_i = std::sqrt(1 - sine2);
        Direction const wi(-wo.x() * relative, -wo.y() * relative, from_outside ? -cosine_i : cosine_i);
        Lanes reach;
        for (int i = 0; i < lane_count; ++i) reach.lane[i] = eta.lane[i] == eta.lane[0] ? 1.0f : 0.0f;
        return std::optional<BsdfSample>(std::in_place, wi.normalized(), reach * square(relative), reach, std::nullopt);
    }
};

}  // namespace iride
