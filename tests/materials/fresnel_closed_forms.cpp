// SPDX-License-Identifier: Apache-2.0
#include <catch2/catch.hpp>

#include "materials/fresnel.h"
#include "scene/material_readers.h"
#include "spectral/catalogue.h"

using namespace iride;

namespace {
double F(double angle_deg, double n, double k) { return fresnel(std::cos(angle_deg * M_PI / 180), n, k).unpolarised(); }
}  // namespace

// Values: 50-digit evaluation of the textbook formulas with complex cosines. Fails for the approximation
// ((n^2 + k^2) c^2 - 2 n c + 1) / (...), which is off by 3e-3 at 60 degrees, for Schlick's, for kappa ignored and for
// p and s exchanged.
TEST_CASE("conductors reflect what the exact complex formula says", "[law]") {
    CHECK(F(0, .2, 3.0) == Approx(.92337165).margin(5e-9));
    CHECK(F(60, .2, 3.0) == Approx(.91841108).margin(5e-9));
    CHECK(F(75, .2, 3.0) == Approx(.92522314).margin(5e-9));
    CHECK(F(0, .143, 3.983) == Approx(.96668751).margin(5e-9));
    CHECK(F(60, .143, 3.983) == Approx(.96221985).margin(5e-9));
    CHECK(F(75, .143, 3.983) == Approx(.95927102).margin(5e-9));
    auto const r = fresnel(0.5, 1.1, 6.7);
    CHECK(r.p == Approx(.83525118).margin(5e-9));
    CHECK(r.s == Approx(.95467906).margin(5e-9));
}

// Fails for p and s exchanged, and for Schlick's approximation.
TEST_CASE("dielectrics are conductors with k = 0", "[law]") {
    CHECK(F(30, 1.5, 0) == Approx(.041522626).margin(5e-10));
    CHECK(F(60, 1.5, 0) == Approx(.089186713).margin(5e-10));
    CHECK(F(85, 1.5, 0) == Approx(.612799645).margin(5e-10));
    auto const brewster = fresnel(1 / std::sqrt(1 + 1.5 * 1.5), 1.5, 0.0);  // tan = 1.5
    CHECK(brewster.p == Approx(0).margin(1e-15));
    CHECK(brewster.s == Approx(25.0 / 169).epsilon(1e-12));
}

TEST_CASE("at grazing incidence everything is a mirror", "[law]") {
    for (double n : {.05, .5, 1.0001, 1.5, 4.0})
        for (double k : {0.0, .1, 3.0, 100.0}) CHECK(F(90, n, k) == Approx(1).margin(1e-12));
}

// Fails when the far medium's normal component is real there too.
TEST_CASE("beyond the critical angle reflection is total", "[law]") {
    for (double angle = 41.9; angle < 90; angle += 1.7) {
        CHECK(F(angle, 1 / 1.5, 0) == Approx(1).margin(1e-14));
        CHECK(fresnel(static_cast<float>(std::cos(angle * M_PI / 180)), 1 / 1.5f, 0.0f).unpolarised() ==
              Approx(1).margin(1e-6));
    }
}

// Fails for Schlick's approximation.
TEST_CASE("both sides of an interface reflect alike at conjugate angles", "[law]") {
    for (double angle : {10., 30., 50., 70., 85.}) {
        double const inside = std::asin(std::sin(angle * M_PI / 180) / 1.7) * 180 / M_PI;
        CHECK(F(angle, 1.7, 0) == Approx(F(inside, 1 / 1.7, 0)).epsilon(1e-10));
    }
}

TEST_CASE("lanes agree with double precision to 1e-5", "[law]") {
    for (float n : {.05f, .3f, 1.5f, 5.f})
        for (float k : {0.f, .5f, 3.f, 9.f})
            for (float c : {1.f, .9f, .5f, .1f, 1e-3f}) {
                double const exact =
                    fresnel(static_cast<double>(c), static_cast<double>(n), static_cast<double>(k)).unpolarised();
                CHECK(fresnel_unpolarised(c, Lanes(n), Lanes(k))[0] == Approx(exact).epsilon(1e-5));
            }
}

// What an absorbing body's surface leaves out by n alone, at the largest k that is let in. From inside a wave that
// falls off is not of one amplitude along the surface; the formula with its complex index says how much that may be.
TEST_CASE("k changes the reflectance of a transparent body by 2e-6 from outside, .004 on average from inside",
          "[law]") {
    double const k = largest_transparent_k;
    for (double n : {1.3, 1.5, 2.0, 3.0}) {
        for (double angle = 0; angle < 90; angle += .25) CHECK(std::abs(F(angle, n, k) - F(angle, n, 0)) < 2e-6);
        std::complex<double> const out = 1.0 / std::complex<double>(n, k);  // kappa < 0: the wave grows towards it
        double sum = 0;
        constexpr int steps = 4000;
        for (int i = 0; i < steps; ++i) {
            double const c = (i + .5) / steps;
            std::complex<double> const q = std::sqrt(out * out - (1 - c * c));
            double const s = std::norm((c - q) / (c + q)), p = std::norm((out * out * c - q) / (out * out * c + q));
            sum += 2 * c / steps * std::abs((s + p) / 2 - fresnel(c, 1 / n, 0.0).unpolarised());
        }
        CHECK(sum < .004);
    }
}

TEST_CASE("BK7 reflects .042165 of yellow light at normal incidence", "[law]") {
    double const n = load_complex_index("BK7").n.at(587.6);
    CHECK(n == Approx(1.5168).margin(2e-5));
    CHECK(F(0, n, 0) == Approx(.042165).margin(3e-6));
}
