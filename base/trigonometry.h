// SPDX-License-Identifier: Apache-2.0
// Sine, cosine and arctangent in single precision, without branches or tables, for the sampling loop: angles that come
// from random numbers are given in turns, which are reduced exactly. Polynomials of [Moshier 1992].
#pragma once

#include <algorithm>
#include <cmath>

#include "base/constants.h"

namespace iride {

struct SineCosine {
    float sine, cosine;
};

// Of an angle x [rad], |x| <= pi / 4. Error below 6e-8, absolute.
inline SineCosine sine_cosine_of_octant(float x) {
    float const z = x * x;
    float const sine = ((-1.9515295891e-4f * z + 8.3321608736e-3f) * z - 1.6666654611e-1f) * z * x + x;
    float const cosine =
        ((2.443315711809948e-5f * z - 1.388731625493765e-3f) * z + 4.166664568298827e-2f) * z * z - 0.5f * z + 1;
    return {sine, cosine};
}

// Of an angle of t turns (2 pi t), |t| < 2^20. Error below 1e-7, absolute.
inline SineCosine sine_cosine_of_turns(float t) {
    float const quarter = std::nearbyint(4 * t);
    auto const [s, c] = sine_cosine_of_octant(2 * pi * (t - 0.25f * quarter));
    int const q = static_cast<int>(quarter);
    float const sine = q & 1 ? c : s, cosine = q & 1 ? s : c;
    return {q & 2 ? -sine : sine, (q + 1) & 2 ? -cosine : cosine};
}

// Angle of (x, y) against the x axis [rad], -pi .. pi; of (0, 0): 0. Relative error below 2.5e-7, so that small angles
// keep their digits.
inline float arctangent(float y, float x) {
    constexpr float tan_pi_8 = 0.41421356f;
    float const ax = std::abs(x), ay = std::abs(y), large = std::max(ax, ay), small = std::min(ax, ay);
    // small / large = tan a, 0 <= a <= pi / 4; beyond pi / 8 by tan(a - pi / 4) = (small - large) / (small + large).
    bool const beyond = small > tan_pi_8 * large;
    float const above = beyond ? small - large : small, below = beyond ? small + large : large;
    float const r = below > 0 ? above / below : 0, z = r * r;
    float const a =
        (((8.05374449538e-2f * z - 1.38776856032e-1f) * z + 1.99777106478e-1f) * z - 3.33329491539e-1f) * z * r + r +
        (beyond ? pi / 4 : 0);
    float const first = ay > ax ? pi / 2 - a : a, half = x < 0 ? pi - first : first;
    return std::copysign(half, y);
}

}  // namespace iride
