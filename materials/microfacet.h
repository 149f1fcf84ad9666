// SPDX-License-Identifier: Apache-2.0
// The GGX (Trowbridge-Reitz) distribution of microfacet normals, its Smith masking, and visible-normal sampling.
//   D(h)      = 1 / (pi a^2 c^4 (1 + t^2 / a^2)^2)       c, t: cosine and tangent of h against the normal
//   Lambda(w) = (sqrt(1 + a^2 tan^2 w) - 1) / 2
//   G1(w)     = 1 / (1 + Lambda(w))         G2(wo, wi) = 1 / (1 + Lambda(wo) + Lambda(wi)), height correlated
//   visible normals: D_w(h) = G1(w) D(h) <w, h> / cos w.            [Walter 2007] [Heitz 2014] [Dupuy 2023]
#pragma once

#include "base/warp.h"

namespace iride {

struct Ggx {
    float alpha;  // rms-like slope, > 0

    // [1/sr]. From the components of h: no 1 - cos^2, so precise for small alpha.
    PerSteradian distribution(Direction const& h) const {
        float const slope2 = (square(h.x()) + square(h.y())) / square(alpha);
        return PerSteradian(1 / (pi * square(alpha) * square(square(h.z()) + slope2)));
    }

    float lambda(Direction const& w) const {
        constexpr float steepest = 1e30f;  // keeps the quotient below finite for w in the surface
        float const slope2 = std::min(steepest, square(alpha) * (square(w.x()) + square(w.y())) / square(w.z()));
        return slope2 / (2 * (std::sqrt(1 + slope2) + 1));  // (sqrt(1 + s) - 1) / 2 without cancellation
    }
    float masking(Direction const& w) const { return 1 / (1 + lambda(w)); }
    float masking_shadowing(Direction const& wo, Direction const& wi) const {
        return 1 / (1 + lambda(wo) + lambda(wi));
    }

    // A normal visible from w (w.z > 0): stretch to the hemisphere, where the visible half vectors fill a spherical
    // cap, sample the cap uniformly, and stretch back. [Dupuy 2023]
    Direction visible_normal(Direction const& w, Sample2 u) const {
        Direction const stretched = Vector(alpha * w.x(), alpha * w.y(), w.z()).normalized();
        float const z = (1 - u.y) * (1 + stretched.z()) - stretched.z();
        float const r = std::sqrt(std::clamp(1 - z * z, 0.0f, 1.0f));
        auto const [sine, cosine] = sine_cosine_of_turns(u.x);
        Vector const h = Vector(r * cosine, r * sine, z) + stretched;
        return Vector(alpha * h.x(), alpha * h.y(), std::max(h.z(), 0.0f)).normalized();
    }

    // Density of visible_normal(w) [1/sr of h].
    PerSteradian visible_density(Direction const& w, Direction const& h) const {
        return distribution(h) * (masking(w) * std::max(0.0f, w.dot(h)) / w.z());
    }
};

}  // namespace iride
