// SPDX-License-Identifier: Apache-2.0
// Geometry of several points at a time: Real is a float or a register of eight, and a formula written once serves both.
#pragma once

#include <cmath>
#include <cstdint>

namespace iride {

inline constexpr int real_lanes = 8;
using Real8 = float __attribute__((vector_size(real_lanes * sizeof(float))));
using Int8 = std::int32_t __attribute__((vector_size(real_lanes * sizeof(std::int32_t))));

template <class Real>
struct IntegerOf;
template <>
struct IntegerOf<float> {
    using type = std::int32_t;
};
template <>
struct IntegerOf<Real8> {
    using type = Int8;
};

inline float square_root(float x) { return std::sqrt(x); }
inline Real8 square_root(Real8 x) {
    for (int i = 0; i < real_lanes; ++i) x[i] = std::sqrt(x[i]);
    return x;
}

// Whether a comparison holds in one of the eight.
inline bool holds_somewhere(Int8 condition) {
    using Long4 = std::int64_t __attribute__((vector_size(sizeof(Int8))));
    auto const pairs = reinterpret_cast<Long4>(condition);
    return (pairs[0] | pairs[1] | pairs[2] | pairs[3]) != 0;
}

// Where `condition` holds a, else b, lane by lane.
template <class Condition, class Real>
Real select(Condition condition, Real a, Real b) {
    return condition ? a : b;
}

template <class Real>
Real larger(Real a, Real b) {
    return select(a > b, a, b);
}
template <class Real>
Real smaller(Real a, Real b) {
    return select(a < b, a, b);
}
template <class Real>
Real clamped(Real x, Real low, Real high) {
    return smaller(larger(x, low), high);
}
template <class Real>
Real magnitude(Real x) {
    return larger(x, -x);
}
// |x| with the sign of s; of s = 0: |x|.
template <class Real>
Real with_sign(Real x, Real s) {
    Real const m = magnitude(x);
    return select(s < Real{}, -m, m);
}

// To the nearest whole number, ties to even, |x| < 2^22: added to 1.5 2^23, whose unit in the last place is 1.
template <class Real>
Real nearest_whole(Real x) {
    constexpr float shift = 0x1.8p23f;
    return (x + shift) - shift;
}
inline std::int32_t to_integer(float x) { return static_cast<std::int32_t>(x); }
inline Int8 to_integer(Real8 x) { return __builtin_convertvector(x, Int8); }

}  // namespace iride
