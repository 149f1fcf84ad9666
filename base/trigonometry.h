// SPDX-License-Identifier: Apache-2.0
// Sine, cosine and arctangent in single precision, without branches or tables, for the sampling loop: angles that come
// from random numbers are given in turns, which are reduced exactly. Polynomials of [Moshier 1992].
#pragma once

#include "base/constants.h"
#include "base/simd.h"

namespace iride {

template <class Real>
struct SineCosine {
    Real sine, cosine;
};

// Of an angle x [rad], |x| <= pi / 4. Error below 6e-8, absolute.
template <class Real>
SineCosine<Real> sine_cosine_of_octant(Real x) {
    Real const z = x * x;
    Real const sine = ((-1.9515295891e-4f * z + 8.3321608736e-3f) * z - 1.6666654611e-1f) * z * x + x;
    Real const cosine =
        ((2.443315711809948e-5f * z - 1.388731625493765e-3f) * z + 4.166664568298827e-2f) * z * z - 0.5f * z + 1.0f;
    return {sine, cosine};
}

// Of an angle of t turns (2 pi t), |t| < 2^20. Error below 1e-7, absolute.
template <class Real>
SineCosine<Real> sine_cosine_of_turns(Real t) {
    Real const quarter = nearest_whole(4 * t);
    auto const [s, c] = sine_cosine_of_octant(2 * pi * (t - 0.25f * quarter));
    auto const q = to_integer(quarter);
    Real const sine = select((q & 1) != 0, c, s), cosine = select((q & 1) != 0, s, c);
    return {select((q & 2) != 0, -sine, sine), select(((q + 1) & 2) != 0, -cosine, cosine)};
}

// Angle of (x, y) against the x axis [rad], -pi .. pi; of (0, 0): 0. Relative error below 2.5e-7, so that small angles
// keep their digits.
template <class Real>
Real arctangent(Real y, Real x) {
    constexpr float tan_pi_8 = 0.41421356f;
    Real const zero{}, ax = magnitude(x), ay = magnitude(y), large = larger(ax, ay), small = smaller(ax, ay);
    // small / large = tan a, 0 <= a <= pi / 4; beyond pi / 8 by tan(a - pi / 4) = (small - large) / (small + large).
    auto const beyond = small > tan_pi_8 * large;
    Real const above = select(beyond, small - large, small), below = select(beyond, small + large, large);
    Real const r = select(below > zero, above / below, zero), z = r * r;
    Real const a =
        (((8.05374449538e-2f * z - 1.38776856032e-1f) * z + 1.99777106478e-1f) * z - 3.33329491539e-1f) * z * r + r +
        select(beyond, zero + pi / 4, zero);
    Real const first = select(ay > ax, pi / 2 - a, a), half = select(x < zero, pi - first, first);
    return with_sign(half, y);
}

}  // namespace iride
