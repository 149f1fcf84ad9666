// SPDX-License-Identifier: Apache-2.0
// Reconstruction filters, importance sampled: the offset of a sample from its pixel's centre is drawn from the filter
// itself, so no sample is weighed by it, and each belongs to one pixel alone. [Ernst 2006]
#pragma once

#include <cmath>

#include "base/constants.h"
#include "base/sampler.h"
#include "base/trigonometry.h"

namespace iride {

// Offset in one dimension from u in [0, 1), for a filter of the given radius [pixels].
inline float sample_box(float u, float radius) { return (2 * u - 1) * radius; }

// Density (1 - |x| / radius) / radius.
inline float sample_triangle(float u, float radius) {
    return u < 0.5f ? radius * (std::sqrt(2 * u) - 1) : radius * (1 - std::sqrt(2 - 2 * u));
}

inline constexpr float gaussian_inside = 0.98889100f;  // 1 - exp(-9/2)

// A Gaussian of standard deviation radius / 3, by Box and Muller's transform, which makes both coordinates at once; the
// radius is cut at 3 standard deviations by drawing it from the cut distribution.
inline Sample2 sample_gaussian(Sample2 u, float radius) {
    float const r = radius / 3 * std::sqrt(-2 * std::log1p(-u.x * gaussian_inside));
    auto const [sine, cosine] = sine_cosine_of_turns(u.y);
    return {r * cosine, r * sine};
}

// The densities of these offsets: what a splat at that offset from a pixel's centre weighs there [pixels^-1, Gaussian:
// pixels^-2].
inline float box_density(float x, float radius) { return x >= -radius && x < radius ? 1 / (2 * radius) : 0; }
inline float triangle_density(float x, float radius) {
    float const share = 1 - std::abs(x) / radius;
    return share > 0 ? share / radius : 0;
}
inline float gaussian_density(Sample2 d, float radius) {
    float const variance = radius * radius / 9, r2 = d.x * d.x + d.y * d.y;
    return r2 < radius * radius ? std::exp(-r2 / (2 * variance)) / (2 * pi * variance * gaussian_inside) : 0;
}

}  // namespace iride
