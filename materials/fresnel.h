// SPDX-License-Identifier: Apache-2.0
// Exact Fresnel equations for a plane boundary: reflectances between a transparent medium and one of complex index, per
// lane, and complex amplitudes between any two media.
//   eta + i kappa   index of the far medium over that of the near one
//   c, s            cosine and sine of the angle of incidence
//   a + i b         = sqrt((eta + i kappa)^2 - s^2), the far medium's normal component of the wave vector
//   Rs = |(c - (a + ib)) / (c + (a + ib))|^2
//   Rp = Rs |((ac - s^2) + ibc) / ((ac + s^2) + ibc)|^2
// Written as sums of squares: no cancellation at Brewster's angle, at grazing or for kappa = 0, where it is the
// dielectric formula and, beyond the critical angle (a = 0), exactly 1. [Born 1999, secs. 1.5 and 14.2]
#pragma once

#include <complex>
#include <limits>

#include "spectral/sampled.h"

namespace iride {

// Reflectances of power for light polarised perpendicular (s) and parallel (p) to the plane of incidence.
template <class Number>
struct FresnelReflectance {
    Number s, p;
    Number unpolarised() const { return (s + p) / 2; }
};

// The root a + i b with a, b >= 0 of a square: difference = a^2 - b^2, product = a b >= 0. Whichever of the two would
// suffer from cancellation is found from the product.
template <class Real>
[[gnu::always_inline]] inline void root_of_square(Real difference, Real product, Real& a, Real& b) {
    Real const modulus = std::sqrt(difference * difference + 4 * product * product);
    Real const major = std::sqrt(Real(0.5) * (modulus + std::abs(difference)));
    Real const minor = major > 0 ? product / major : Real(0);
    a = difference >= 0 ? major : minor;
    b = difference >= 0 ? minor : major;
}

// eta^2 - sin^2, right to the last digits also where the two are nearly the same, at the critical angle: whichever of
// sin^2 and eta^2 - 1 is not below 1/2 there has an exact remainder, which is carried along. Every product is in an
// fma(), so that no compiler can round another way.
template <class Real>
[[gnu::always_inline]] inline Real above_critical(Real cosine, Real eta) {
    Real const sine2 = std::fma(-cosine, cosine, Real(1)), more_sine2 = std::fma(-cosine, cosine, 1 - sine2);
    Real const excess = std::fma(eta, eta, Real(-1)), more_excess = std::fma(eta, eta, -1 - excess);
    return sine2 >= Real(0.5) ? std::fma(eta, eta, -sine2) - more_sine2
                              : std::fma(cosine, cosine, excess) + more_excess;
}

// (Inlined by order: only then are the lanes' loops compiled to SIMD instructions.)
//
// One wavelength, any real type: the reference for the lanes, and what colorimetry integrates. cosine in [0, 1].
// Relative error below 1e-12 in double, 1e-5 in float, of s and of the mean; of p but for a share 1e-3 of s.
template <class Real>
[[gnu::always_inline]] inline FresnelReflectance<Real> fresnel(Real cosine, Real eta, Real kappa) {
    auto const sq = [](Real x) { return x * x; };
    Real const sine2 = std::max(Real(0), (1 - cosine) * (1 + cosine));
    Real a, b;
    root_of_square(above_critical(cosine, eta) - sq(kappa), eta * kappa, a, b);
    // a - c: where these are nearly alike from a^2 - c^2 = eta^2 - 1 - kappa^2 + b^2.
    Real const sum = a + cosine, alike = (std::fma(eta, eta, Real(-1)) - sq(kappa) + sq(b)) / sum;
    Real const b2 = sq(b), bc2 = b2 * sq(cosine), ac = a * cosine;
    // Denominators vanish along a boundary between equal media, which reflects nothing, and at c = 1 if a = b = 0.
    constexpr Real tiny = std::numeric_limits<Real>::min();
    Real const s = (sq(b < a && a < 2 * cosine ? alike : a - cosine) + b2) / std::max(sq(sum) + b2, tiny);
    // The second factor is 1 by itself at c = 0, s^2 = 1, and at c = 1, s = 0 unless a = b = 0.
    Real const p_over_s = (sq(ac - sine2) + bc2) / std::max(sq(ac + sine2) + bc2, tiny);
    return {s, s * p_over_s};
}

// A medium as a plane wave meets it: N = n + ik, and q = sqrt(N^2 - S^2), Re q, Im q >= 0, the normal component of its
// wave vector over that of vacuum. S = n sin(angle of incidence) is the same in every medium.
template <class Real>
struct WaveMedium {
    std::complex<Real> N, q;
};
template <class Real>
WaveMedium<Real> wave_medium(std::complex<Real> N, Real S2) {
    Real const n = N.real(), k = N.imag(), S = std::sqrt(S2);
    Real a, b;
    root_of_square((n - S) * (n + S) - k * k, n * k, a, b);
    return {N, {a, b}};
}

// Electric amplitudes behind (t) and before (r) a boundary, over that of the arriving wave; their arguments are the
// jumps of phase, fields varying as exp(-i omega t). At normal incidence r_p = -r_s.
template <class Real>
struct FresnelAmplitudes {
    std::complex<Real> r_s, r_p, t_s, t_p;
};
// r_s = (q1 - q2)/(q1 + q2), r_p = (N2^2 q1 - N1^2 q2)/(N2^2 q1 + N1^2 q2), t_s = 1 + r_s, t_p = (1 + r_p) N1/N2; N >
// 0. Both q are 0 only along a boundary between equal media, which is none.
template <class Real>
FresnelAmplitudes<Real> fresnel_amplitudes(WaveMedium<Real> const& near, WaveMedium<Real> const& far) {
    auto const ratio = [](std::complex<Real> x, std::complex<Real> y) {
        return x + y == std::complex<Real>(0) ? std::complex<Real>(0) : (x - y) / (x + y);
    };
    std::complex<Real> const s = ratio(near.q, far.q);
    std::complex<Real> const p = ratio(far.N * far.N * near.q, near.N * near.N * far.q);
    return {s, p, Real(1) + s, (Real(1) + p) * (near.N / far.N)};
}

// All lanes at once. One loop, compiled to SIMD instructions if all that it calls is part of it. [dimensionless]
[[gnu::flatten, gnu::always_inline]] inline Lanes fresnel_unpolarised(float cosine, Lanes eta, Lanes kappa) {
    Lanes result;
    for (int i = 0; i < lane_count; ++i) result.lane[i] = fresnel(cosine, eta.lane[i], kappa.lane[i]).unpolarised();
    return result;
}

// Reflectance of unpolarised light that comes from everywhere alike: 2 int_0^1 R(mu) mu dmu, by the midpoint rule, to
// 1e-4 of the value. [dimensionless]
inline double mean_fresnel(double eta, double kappa) {
    constexpr int steps = 256;
    double sum = 0;
    for (int i = 0; i < steps; ++i) {
        double const cosine = (i + 0.5) / steps;
        sum += fresnel(cosine, eta, kappa).unpolarised() * cosine;
    }
    return 2 * sum / steps;
}

}  // namespace iride
