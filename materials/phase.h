// SPDX-License-Identifier: Apache-2.0
// Henyey-Greenstein's phase function: the density over solid angle of the angle t between the directions before and
// after a scattering, of mean cosine g, -1 < g < 1.
//   p(t) = (1 - g^2) / (4 pi (1 + g^2 - 2 g cos t)^(3/2))                                        [Henyey 1941, eq. 2]
// Its distribution is inverted in closed form: u in [0, 1) -> cos t, by v = 2 u - 1,
//   cos t = (2 v + g (v^2 + 3) + 2 g^2 v + g^3 (v^2 - 1)) / (2 (1 + g v)^2)
// which is the usual inverse, multiplied out: it has no pole at g = 0 and cancels nowhere.
#pragma once

#include "base/warp.h"

namespace iride {

class HenyeyGreenstein {
  public:
    // `travel`: the direction in which the path comes, towards the point. Light that goes the other way is scattered by
    // the same angle.
    HenyeyGreenstein(float g, Direction const& travel) : g_(g), travel_(travel) {}

    // p [1/sr] of going on along wi; value and density of sample() are the same.
    PerSteradian density(Direction const& wi) const {
        float const rise = square(1 - g_) + 2 * g_ * (1 - travel_.dot(wi));  // 1 + g^2 - 2 g cos t
        return PerSteradian((1 - g_) * (1 + g_) * inverse_pi / 4 / (rise * std::sqrt(rise)));
    }
    Direction sample(Sample2 u) const {
        float const v = 2 * u.x - 1, g2 = g_ * g_, v2 = v * v;
        float const cosine = std::clamp(
            (2 * v + g_ * (v2 + 3) + 2 * g2 * v + g2 * g_ * (v2 - 1)) / (2 * square(1 + g_ * v)), -1.0f, 1.0f);
        float const r = std::sqrt(std::max(0.0f, 1 - cosine * cosine));
        auto const [s, c] = sine_cosine_of_turns(u.y);
        return Frame::around(travel_).to_world({r * c, r * s, cosine});
    }

  private:
    float g_;
    Direction travel_;
};

}  // namespace iride
