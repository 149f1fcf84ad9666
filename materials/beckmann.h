// SPDX-License-Identifier: Apache-2.0
// The Beckmann distribution of microfacet normals: Gaussian slopes.
//   D(h)      = exp(-(h.x / (ax h.z))^2 - (h.y / (ay h.z))^2) / (pi ax ay h.z^4)
//   Lambda(w) = exp(-a^2) / (2 a sqrt(pi)) - erfc(a) / 2,      a = w.z / sqrt((ax w.x)^2 + (ay w.y)^2)
// Visible normals: in the stretched frame the slope x away from w has density ~ (cos w - x sin w)+ exp(-x^2), drawn by
// inversion, the slope across it is Gaussian.       [HeitzEon 2014] [Jakob 2014]
#pragma once

#include "base/error_function.h"
#include "materials/microfacet.h"

namespace iride {

struct Beckmann {
    float alpha_x, alpha_y;  // sqrt(2) times the rms slopes along x and y, > 0

    // [1/sr]
    PerSteradian distribution(Direction const& h) const {
        float const z2 = square(h.z());
        float const exponent = (square(h.x() / alpha_x) + square(h.y() / alpha_y)) / z2;
        constexpr float beyond = 80;  // exp(-80) is 0 beside everything, and 1 / z^4 stays finite
        if (!(exponent < beyond)) return PerSteradian(0);
        return PerSteradian(std::exp(-exponent) / (pi * alpha_x * alpha_y * square(z2)));
    }

    float lambda(Direction const& w) const {
        float const a = std::abs(w.z()) / std::sqrt(square(alpha_x * w.x()) + square(alpha_y * w.y()));
        constexpr float unmasked = 4;  // Lambda(4) < 1e-9
        if (!(a < unmasked)) return 0;
        return std::max(0.0f, std::exp(-a * a) / (2 * sqrt_pi * a) - std::erfc(a) / 2);
    }

    Direction visible_normal(Direction const& w, Sample3 const& u) const {
        Vector const stretched = Vector(alpha_x * w.x(), alpha_y * w.y(), w.z()).normalized();
        float const sine = std::sqrt(square(stretched.x()) + square(stretched.y())), cosine = stretched.z();
        Vector2 const along = sine > 0 ? Vector2(stretched.head<2>() / sine) : Vector2(1, 0);
        float const x = -visible_slope(cosine, sine, u.direction.y);
        float const y = inverse_error_function(2 * u.direction.x - 1);
        return Vector(alpha_x * (x * along.x() - y * along.y()), alpha_y * (x * along.y() + y * along.x()), 1)
            .normalized();
    }

    // Of density D(h) h.z.
    Direction normal(Sample2 u) const {
        float const r = std::sqrt(-std::log1p(-u.y));
        auto const [sine, cosine] = sine_cosine_of_turns(u.x);
        return Vector(alpha_x * r * cosine, alpha_y * r * sine, 1).normalized();
    }

  private:
    static constexpr float sqrt_pi = 1.7724538509f;

    // x of density ~ (c - x s)+ exp(-x^2): C(v) = u C(V) for v = (1 + erf x) / 2, where
    //   C(v) = sqrt(pi) c v + s exp(-x^2) / 2,   dC/dv = sqrt(pi) (c - s x),   V: where c = s x
    // C is concave, so that Newton's steps, after the first, come from one side.
    static float visible_slope(float c, float s, float u) {
        float const cotangent = c / s, most = s > 0 ? (1 + std::erf(cotangent)) / 2 : 1;
        float const total = sqrt_pi * c * most + (s > 0 ? s * std::exp(-square(cotangent)) / 2 : 0);
        float v = u * most, x = inverse_error_function(2 * v - 1);
        for (int newton = 0; newton < 8; ++newton) {
            float const slope = sqrt_pi * (c - s * x);
            if (!(slope > 0)) break;
            float const step = (sqrt_pi * c * v + s * std::exp(-x * x) / 2 - u * total) / slope;
            v = std::clamp(v - step, 0.0f, most);
            x = inverse_error_function(2 * v - 1);
            constexpr float good = 1e-6f;  // of the probability: below what a float u tells apart after 2 v - 1
            if (std::abs(step) < good) break;
        }
        return s > 0 ? std::min(x, cotangent) : x;
    }
};

}  // namespace iride
