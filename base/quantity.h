// SPDX-License-Identifier: Apache-2.0
// Physical dimensions in the type: a number carries its exponents of watt, metre, steradian and nanometre, and the
// compiler does the dimensional analysis. Steradian is kept apart from 1 on purpose: it is what tells a density over
// area from one over solid angle. At -O3 a Quantity is the same instruction stream as a bare float.
#pragma once

namespace iride {

// Exponents of a product of units, e.g. spectral radiance W m^-2 sr^-1 nm^-1 = {1, -2, -1, -1}.
struct Dimension {
    int watt = 0, metre = 0, steradian = 0, nanometre = 0;
    friend constexpr bool operator==(Dimension, Dimension) = default;
};

constexpr Dimension operator*(Dimension a, Dimension b) {
    return {a.watt + b.watt, a.metre + b.metre, a.steradian + b.steradian, a.nanometre + b.nanometre};
}
constexpr Dimension operator/(Dimension a, Dimension b) {
    return {a.watt - b.watt, a.metre - b.metre, a.steradian - b.steradian, a.nanometre - b.nanometre};
}

namespace dim {
inline constexpr Dimension none{};
inline constexpr Dimension metre{.metre = 1};
inline constexpr Dimension per_metre{.metre = -1};
inline constexpr Dimension per_square_metre{.metre = -2};
inline constexpr Dimension per_steradian{.steradian = -1};
inline constexpr Dimension per_nanometre{.nanometre = -1};
inline constexpr Dimension spectral_radiance{.watt = 1, .metre = -2, .steradian = -1, .nanometre = -1};
inline constexpr Dimension spectral_irradiance{.watt = 1, .metre = -2, .nanometre = -1};
inline constexpr Dimension spectral_intensity{.watt = 1, .steradian = -1, .nanometre = -1};
}  // namespace dim

// A float of dimension D. A pure number (D = none) converts freely; everything else only through arithmetic.
template <Dimension D>
struct Quantity {
    float value = 0;

    constexpr Quantity() = default;
    constexpr explicit(D != dim::none) Quantity(float number) : value(number) {}
    constexpr operator float() const requires(D == dim::none) { return value; }

    friend constexpr Quantity operator+(Quantity a, Quantity b) { return Quantity(a.value + b.value); }
    friend constexpr Quantity operator-(Quantity a, Quantity b) { return Quantity(a.value - b.value); }
    friend constexpr Quantity operator*(Quantity a, float s) { return Quantity(a.value * s); }
    friend constexpr Quantity operator*(float s, Quantity a) { return Quantity(s * a.value); }
    friend constexpr Quantity operator/(Quantity a, float s) { return Quantity(a.value / s); }
    friend constexpr auto operator<=>(Quantity, Quantity) = default;
};

template <Dimension A, Dimension B>
requires(A != dim::none && B != dim::none) constexpr auto operator*(Quantity<A> a, Quantity<B> b) {
    return Quantity<A * B>(a.value * b.value);
}
template <Dimension A, Dimension B>
requires(B != dim::none) constexpr auto operator/(Quantity<A> a, Quantity<B> b) {
    return Quantity<A / B>(a.value / b.value);
}

using Metres = Quantity<dim::metre>;
using PerSquareMetre = Quantity<dim::per_square_metre>;
using PerSteradian = Quantity<dim::per_steradian>;

// Density over area -> density over solid angle: p r^2 / |cos|, [1/m^2] -> [1/sr]. The only bridge between the two.
// `cosine` is the angle between the area's normal and the direction to the observer; at 0 the density is infinite.
constexpr PerSteradian to_solid_angle(PerSquareMetre p, Metres r, float cosine) {
    return PerSteradian(p.value * r.value * r.value / (cosine < 0 ? -cosine : cosine));
}

}  // namespace iride
