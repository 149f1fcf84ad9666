// SPDX-License-Identifier: Apache-2.0
// What every model of microfacets says of itself, and the GGX (Trowbridge-Reitz) distribution, the one with a closed
// form for everything. In general, with slopes of the facets (-h.x, -h.y) / h.z of joint density P:
//   D(h)      = P / h.z^4
//   G1(w, h)  = 1 / (1 + Lambda(w, h))                   share of the facets h that w sees
//   G2        = 1 / (1 + joint(Lambda(wo, h), Lambda(wi, h)))   both see them; Smith: the sum, height correlated
//   visible normals: D_w(h) = G1(w, h) D(h) <w, h> / w.z
// GGX: D = 1 / (pi ax ay (h.z^2 + (h.x / ax)^2 + (h.y / ay)^2)^2),
//      Lambda(w) = (sqrt(1 + ((ax w.x)^2 + (ay w.y)^2) / w.z^2) - 1) / 2.  [Walter 2007] [Heitz 2014] [Dupuy 2023]
#pragma once

#include <concepts>

#include "base/warp.h"
#include "materials/bsdf.h"

namespace iride {

template <class T>
concept FacetModel = requires(T const& facets, Direction const& w, float lambda, Sample3& u) {
    { facets.distribution(w) } -> std::same_as<PerSteradian>;
    { facets.lambda(w, w) } -> std::same_as<float>;
    { facets.joint(lambda, lambda) } -> std::same_as<float>;
    { facets.visible_normal(w, u) } -> std::same_as<Direction>;  // w.z > 0; what is left of u.lobe is uniform again
};

struct Ggx {
    float alpha_x, alpha_y;  // rms-like slopes along x and y, > 0

    Ggx(float alpha) : Ggx(alpha, alpha) {}
    Ggx(float ax, float ay) : alpha_x(ax), alpha_y(ay) {}

    // [1/sr]. From the components of h: no 1 - cos^2, so precise for small alpha.
    [[gnu::always_inline]] PerSteradian distribution(Direction const& h) const {
        float const product = alpha_x * alpha_y;
        float const sum = square(product * h.z()) + square(alpha_y * h.x()) + square(alpha_x * h.y());
        return PerSteradian(product / (pi * square(sum / product)));
    }

    [[gnu::always_inline]] float lambda(Direction const& w) const {
        constexpr float steepest = 1e30f;  // keeps the quotient below finite for w in the surface
        float const slope2 = std::min(steepest, (square(alpha_x * w.x()) + square(alpha_y * w.y())) / square(w.z()));
        return slope2 / (2 * (std::sqrt(1 + slope2) + 1));  // (sqrt(1 + s) - 1) / 2 without cancellation
    }
    float lambda(Direction const& w, Direction const&) const { return lambda(w); }
    static float joint(float lambda_o, float lambda_i) { return lambda_o + lambda_i; }

    // Stretch to the hemisphere, where the visible half vectors fill a spherical cap, sample the cap uniformly, and
    // stretch back. [Dupuy 2023]
    [[gnu::always_inline]] Direction visible_normal(Direction const& w, Sample3 const& u) const {
        Direction const stretched = unit({alpha_x * w.x(), alpha_y * w.y(), w.z()});
        float const z = (1 - u.direction.y) * (1 + stretched.z()) - stretched.z();
        float const r = std::sqrt(std::clamp(1 - z * z, 0.0f, 1.0f));
        auto const [sine, cosine] = sine_cosine_of_turns(u.direction.x);
        Vector const h = Vector(r * cosine, r * sine, z) + stretched;
        return unit({alpha_x * h.x(), alpha_y * h.y(), std::max(h.z(), least_height)});
    }

    // Of density D(h) h.z.
    Direction normal(Sample2 u) const {
        float const r = std::sqrt(u.y / (1 - u.y));
        auto const [sine, cosine] = sine_cosine_of_turns(u.x);
        return unit({alpha_x * r * cosine, alpha_y * r * sine, 1});
    }

  private:
    static constexpr float least_height = 1e-12f;  // keeps the vector's square above 0; far below any real height
};

}  // namespace iride
