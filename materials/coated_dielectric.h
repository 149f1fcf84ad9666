// SPDX-License-Identifier: Apache-2.0
// A smooth boundary between two transparent media under thin films, or thin films alone between equal ones: R and T are
// those of the stack for the side of wo, per lane, and R + T < 1 where a film absorbs. With eta as for a bare boundary:
//   reflection:    probability p = R / (R + T),   weight R / p_hero
//   transmission:  probability 1 - p,  Snell's law, radiance scaled by 1 / eta^2, weight T / ((1 - p_hero) eta^2); the
//                  films are too thin to shift it. Between equal media light goes straight on.
// Lanes whose eta differs from the hero's refract elsewhere, and are lost in transmission alone. [Macleod 2017, ch. 2]
#pragma once

#include "materials/bsdf.h"
#include "materials/coating.h"

namespace iride {

struct SmoothCoatedDielectric {
    static constexpr bool has_density = false;
    CoatingTable const* table;  // of the material, which outlives every path
    LaneRegister row;
    Lanes inside, outside;  // n of the body (z < 0) and of what surrounds it (z > 0)

    BsdfEvaluation evaluate(Direction const&, Direction const&) const { return {}; }

    std::optional<BsdfSample> sample(Direction const& wo, Sample3 u) const {
        if (wo.z() == 0) return std::nullopt;
        bool const from_outside = wo.z() > 0;
        auto const [R, T] = table->power(row, std::min(1.0f, std::abs(wo.z())), !from_outside);
        Lanes const left = R + T, share(left.lane > 0.0f ? R.lane / left.lane : LaneRegister{});
        if (left[0] <= 0) return std::nullopt;  // absorbed
        if (u.lobe < share[0]) {
            float const scale = 1 / share[0];
            return std::optional<BsdfSample>(std::in_place, Direction(-wo.x(), -wo.y(), wo.z()), R * scale,
                                             share * scale, std::nullopt);
        }
        Lanes const eta = from_outside ? inside / outside : outside / inside;
        float const relative = 1 / eta[0];
        float const sine2 = (1 - square(wo.z())) * square(relative);
        if (sine2 >= 1) return std::nullopt;  // T is 0 there: reached by rounding only
        float const cosine_i = std::sqrt(1 - std::max(0.0f, sine2));
        Direction const wi(-wo.x() * relative, -wo.y() * relative, from_outside ? -cosine_i : cosine_i);
        Lanes const along(eta.lane == eta[0] ? LaneRegister{} + 1 / (1 - share[0]) : LaneRegister{});
        return std::optional<BsdfSample>(std::in_place, wi.normalized(), along * T * square(relative),
                                         along * (Lanes(1) - share), std::nullopt);
    }
};

}  // namespace iride
