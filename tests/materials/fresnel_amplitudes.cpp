// SPDX-License-Identifier: Apache-2.0
// Amplitudes at a boundary: their squares, their phases, and what is the same from both sides.
#include <catch2/catch.hpp>

#include "base/constants.h"
#include "materials/fresnel.h"

using namespace iride;

namespace {

using Complex = std::complex<double>;

FresnelAmplitudes<double> amplitudes(double degrees, Complex near, Complex far) {
    double const S = near.real() * std::sin(radians(degrees));
    return fresnel_amplitudes(wave_medium(near, S * S), wave_medium(far, S * S));
}

}  // namespace

// Seen to fail with N instead of N^2 in r_p.
TEST_CASE("the squares of the amplitudes are the reflectances", "[unit]") {
    for (Complex const far : {Complex(1.5, 0), {.2, 3}, {.05, .1}, {2.4, .01}, {1.1, 6.7}})
        for (double near : {1., 1.33})
            for (double angle : {0., 30., 56.3, 75., 89.9}) {
                auto const a = amplitudes(angle, near, far);
                auto const F = fresnel(std::cos(radians(angle)), far.real() / near, far.imag() / near);
                CHECK(std::norm(a.r_s) == Approx(F.s).epsilon(1e-12));
                CHECK(std::norm(a.r_p) == Approx(F.p).epsilon(1e-11).margin(1e-16));
            }
}

// tan(delta_s / 2) = -sqrt(sin^2 - n^2) / cos and tan(delta_p / 2) = the same / n^2; 45 degrees in
// glass of 1.5. The sign is that of exp(-i omega t). Seen to fail with the other root of q^2 = N^2 - S^2.
TEST_CASE("total reflection turns the phases by Born and Wolf's half angles", "[law]") {
    auto const a = amplitudes(45, 1.5, 1);
    double const n = 1 / 1.5, half_s = -std::atan(std::sqrt(.5 - n * n) / std::sqrt(.5));
    double const half_p = -std::atan(std::sqrt(.5 - n * n) / (std::sqrt(.5) * n * n));
    CHECK(std::abs(a.r_s) == Approx(1).epsilon(1e-15));
    CHECK(std::arg(a.r_s) == Approx(2 * half_s).epsilon(1e-12));
    CHECK(std::arg(a.r_p) == Approx(2 * half_p).epsilon(1e-12));
}

// s: E is 1 + r = t, H along the boundary q1 (1 - r) = q2 t. p: H is N1 (1 + r) = N2 t, E along it q1/N1 (1 - r) =
// q2/N2 t. Seen to fail with t_p lacking N1 / N2 and with t_s = 1 - r_s.
TEST_CASE("the fields along a boundary are the same on both sides of it", "[law]") {
    for (Complex const dense : {Complex(1.5, 0), {.2, 3}, {2.4, .01}})
        for (double angle : {0., 30., 56.3, 75., 89.9})
            for (bool inwards : {true, false}) {
                double const S = std::sin(radians(angle));
                auto one = wave_medium(Complex(1), S * S), two = wave_medium(dense, S * S);
                if (!inwards) std::swap(one, two);
                auto const a = fresnel_amplitudes(one, two);
                CHECK(std::abs(1.0 + a.r_s - a.t_s) < 1e-14);
                CHECK(std::abs(one.q * (1.0 - a.r_s) - two.q * a.t_s) < 1e-13);
                CHECK(std::abs(one.N * (1.0 + a.r_p) - two.N * a.t_p) < 1e-13);
                CHECK(std::abs(one.q / one.N * (1.0 - a.r_p) - two.q / two.N * a.t_p) < 1e-13);
            }
}

TEST_CASE("amplitudes in single precision agree with double", "[unit]") {
    for (double angle : {0., 45., 85.})
        for (Complex const far : {Complex(1.5, 0), {.2, 3}, {.6, 0}}) {
            auto const exact = amplitudes(angle, 1, far);
            auto const S = static_cast<float>(std::sin(radians(angle)));
            auto const single = fresnel_amplitudes(wave_medium(std::complex<float>(1), S * S),
                                                   wave_medium(std::complex<float>(far), S * S));
            CHECK(std::abs(Complex(single.r_s) - exact.r_s) < 2e-6);
            CHECK(std::abs(Complex(single.r_p) - exact.r_p) < 2e-6);
        }
}
