// SPDX-License-Identifier: Apache-2.0
// Reconstruction filters, importance sampled: the offset of a sample from its pixel's centre is drawn from the filter
// itself, so every sample has weight 1 and belongs to one pixel alone. [Ernst 2006]
#pragma once

#include <cmath>

#include "base/sampler.h"
#include "base/trigonometry.h"

namespace iride {

// Offset in one dimension from u in [0, 1), for a filter of the given radius [pixels].
inline float sample_box(float u, float radius) { return (2 * u - 1) * radius; }

// Density (1 - |x| / radius) / radius.
inline float sample_triangle(float u, float radius) {
    return u < 0.5f ? radius * (std::sqrt(2 * u) - 1) : radius * (1 - std::sqrt(2 - 2 * u));
}

// A Gaussian of standard deviation radius / 3, by Box and Muller's transform, which makes both coordinates at once; the
// radius is cut at 3 standard deviations by drawing it from the cut distribution.
inline Sample2 sample_gaussian(Sample2 u, float radius) {
    constexpr float inside = 0.98889100f;  // 1 - exp(-9/2)
    float const r = radius / 3 * std::sqrt(-2 * std::log1p(-u.x * inside));
    auto const [sine, cosine] = sine_cosine_of_turns(u.y);
    return {r * cosine, r * sine};
}

}  // namespace iride
