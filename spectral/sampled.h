// SPDX-License-Identifier: Apache-2.0
// A quantity at the wavelengths of one path: `lane_count` floats of dimension D in one SIMD register, with lane-wise
// algebra. Which wavelength a lane stands for is told by the path's Wavelengths packet.
#pragma once

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/quantity.h"

namespace iride {

inline constexpr int lane_count = IRIDE_LANES;
using LaneRegister = float __attribute__((vector_size(lane_count * sizeof(float))));

template <Dimension D>
struct Sampled {
    LaneRegister lane;

    Sampled() : lane{} {}
    explicit Sampled(float everywhere) : lane(LaneRegister{} + everywhere) {}
    explicit Sampled(LaneRegister lanes) : lane(lanes) {}

    float operator[](int i) const { return lane[i]; }
    void set(int i, float value) { lane[i] = value; }

    Sampled& operator+=(Sampled b) { return lane += b.lane, *this; }
    Sampled& operator-=(Sampled b) { return lane -= b.lane, *this; }
    Sampled& operator*=(Sampled<dim::none> b) { return lane *= b.lane, *this; }
    Sampled& operator/=(Sampled<dim::none> b) { return lane /= b.lane, *this; }
    Sampled& operator*=(float s) { return lane *= s, *this; }
    Sampled& operator/=(float s) { return lane /= s, *this; }

    friend Sampled operator+(Sampled a, Sampled b) { return Sampled(a.lane + b.lane); }
    friend Sampled operator-(Sampled a, Sampled b) { return Sampled(a.lane - b.lane); }
    friend Sampled operator-(Sampled a) { return Sampled(-a.lane); }
    friend Sampled operator*(Sampled a, float s) { return Sampled(a.lane * s); }
    friend Sampled operator*(float s, Sampled a) { return Sampled(s * a.lane); }
    friend Sampled operator/(Sampled a, float s) { return Sampled(a.lane / s); }
};

template <Dimension A, Dimension B>
Sampled<A * B> operator*(Sampled<A> a, Sampled<B> b) {
    return Sampled<A * B>(a.lane * b.lane);
}
template <Dimension A, Dimension B>
Sampled<A / B> operator/(Sampled<A> a, Sampled<B> b) {
    return Sampled<A / B>(a.lane / b.lane);
}
template <Dimension A, Dimension B>
requires(B != dim::none) Sampled<A * B>
operator*(Sampled<A> a, Quantity<B> b) { return Sampled<A * B>(a.lane * b.value); }
template <Dimension A, Dimension B>
requires(B != dim::none) Sampled<A / B>
operator/(Sampled<A> a, Quantity<B> b) { return Sampled<A / B>(a.lane / b.value); }

using Lanes = Sampled<dim::none>;
using Throughput = Sampled<dim::none>;
using BsdfValue = Sampled<dim::per_steradian>;
using LaneDensity = Sampled<dim::per_steradian>;
using Radiance = Sampled<dim::spectral_radiance>;
using Irradiance = Sampled<dim::spectral_irradiance>;
using Intensity = Sampled<dim::spectral_intensity>;

// Apply a float function lane by lane; the compiler turns simple ones into one instruction.
template <Dimension D, class Function>
Sampled<D> map(Sampled<D> a, Function&& function) {
    for (int i = 0; i < lane_count; ++i) a.lane[i] = function(a.lane[i]);
    return a;
}
inline Lanes sqrt(Lanes a) {
    return map(a, [](float x) { return std::sqrt(x); });
}
template <Dimension D>
Sampled<D> max(Sampled<D> a, Sampled<D> b) {
    return Sampled<D>(a.lane > b.lane ? a.lane : b.lane);
}
template <Dimension D>
Sampled<D> min(Sampled<D> a, Sampled<D> b) {
    return Sampled<D>(a.lane < b.lane ? a.lane : b.lane);
}

// All lanes joined pair by pair, lane i with lane i ^ n / 2, then i ^ n / 4 ...: a tree, so that the steps run side by
// side.
template <std::size_t half = lane_count / 2, class Register, class Join>
auto joined(Register a, Join join) {
    if constexpr (half == 0) {
        return a[0];
    } else {
        auto const turned = [&]<std::size_t... lane>(std::index_sequence<lane...>) {
            return __builtin_shufflevector(a, a, (lane ^ half)...);
        };
        return joined<half / 2>(join(a, turned(std::make_index_sequence<lane_count>())), join);
    }
}
template <Dimension D>
Quantity<D> sum(Sampled<D> a) {
    return Quantity<D>(joined(a.lane, [](LaneRegister x, LaneRegister y) { return x + y; }));
}
template <Dimension D>
Quantity<D> mean(Sampled<D> a) {
    return sum(a) * (1.0f / lane_count);
}
template <Dimension D>
Quantity<D> largest(Sampled<D> a) {
    return Quantity<D>(joined(a.lane, [](LaneRegister x, LaneRegister y) { return x < y ? y : x; }));
}
// Whether a comparison of lanes holds in one of them.
template <class Comparison>
bool any(Comparison c) {
    return joined(c, [](Comparison x, Comparison y) { return x | y; }) != 0;
}
template <Dimension D>
bool is_black(Sampled<D> a) {
    return !any(a.lane != LaneRegister{});
}
template <Dimension D>
bool is_finite(Sampled<D> a) {
    LaneRegister const infinite = LaneRegister{} + __builtin_inff();
    return !any(~((a.lane < infinite) & (a.lane > -infinite)));  // both are false for NaN
}
template <Dimension D>
bool is_negative(Sampled<D> a) {
    return any(a.lane < LaneRegister{});
}

}  // namespace iride
