// SPDX-License-Identifier: Apache-2.0
// Planck's law, tables, steps and formulas against closed forms and physics they must agree with.
#include <catch2/catch.hpp>

#include "base/constants.h"
#include "spectral/catalogue.h"
#include "spectral/spectral_function.h"

using namespace iride;

namespace {

SpectralFunction table(std::vector<double> nm, std::vector<double> value, Outside outside = Outside::hold) {
    return SpectralFunction(TabulatedShape{std::move(nm), std::move(value)}, outside);
}

}  // namespace

// Integral over all wavelengths = sigma T^4 / pi, sigma = 5.670374419e-8 W m^-2 K^-4 (CODATA 2018). Below 50 nm lies
// nothing, beyond 400 um 15 / pi^4 x^3 / 3 with x = c2 / (lambda T) < .018: 3e-7. Fails with exp for expm1 - 1, or per
// m.
TEST_CASE("a blackbody radiates by Stefan and Boltzmann", "[law]") {
    for (double T : {2000.0, 5772.0}) {
        SpectralFunction const body(BlackbodyShape{T}, Outside::hold);
        double const expected = 5.670374419e-8 * std::pow(T, 4) / pi_double;
        CHECK(body.integral({50, 4e5}) == Approx(expected).epsilon(5e-7));
    }
}

// b = 2.897771955e-3 m K (CODATA 2018).
TEST_CASE("a blackbody peaks where Wien says", "[law]") {
    for (double T : {1500.0, 3000.0, 6500.0}) {
        double const peak = 2.897771955e-3 * 1e9 / T, top = planck_radiance(peak, T);
        CHECK(planck_radiance(peak * (1 + 1e-4), T) < top);
        CHECK(planck_radiance(peak * (1 - 1e-4), T) < top);
    }
}

// CIE 15: A is Planck's law at 2848 K for c2 = .01435 m K, which is 2855.5 K with today's constants; 100 at 560 nm.
TEST_CASE("illuminant A is a blackbody of 2856 K", "[law]") {
    SpectralFunction const a = load_spectrum("A", SpectralQuantity::power);
    double const T = 2848 * 0.01438776877 / 0.01435;
    for (double nm = 300; nm <= 780; nm += 5) {
        INFO(nm);
        double const expected = 100 * planck_radiance(nm, T) / planck_radiance(560, T);
        CHECK(a.at(nm) == Approx(expected).epsilon(5e-6));  // six digits are given
    }
}

TEST_CASE("Planck's law stays finite at every temperature and wavelength of a scene", "[unit]") {
    for (double T : {100.0, 1e3, 1e6})
        for (double nm : {10.0, 360.0, 830.0, 1e5}) {
            CHECK(std::isfinite(planck_radiance(nm, T)));
            CHECK(planck_radiance(nm, T) >= 0);
        }
}

TEST_CASE("a table is linear between its points and holds, ends, or goes on outside", "[unit]") {
    std::vector<double> const nm{400, 410.5, 500}, value{1, 2, -1};
    SpectralFunction const held = table(nm, value);
    CHECK(held.at(400) == 1);
    CHECK(held.at(405.25) == Approx(1.5).epsilon(1e-15));
    CHECK(held.at(410.5) == 2);
    CHECK(held.at(500) == Approx(-1).epsilon(1e-15));
    CHECK(held.at(399) == 1);
    CHECK(held.at(501) == -1);
    CHECK(held.largest({360, 830}) == 2);
    CHECK(held.smallest({360, 830}) == -1);
    CHECK(held.largest({450, 830}) == Approx(2 - 3 * 39.5 / 89.5));
    CHECK(held.scaled(-2).at(405.25) == Approx(-3).epsilon(1e-15));
    CHECK(held.scaled(-2).largest({360, 830}) == Approx(2).epsilon(1e-15));
    CHECK(held.defined_on() == WavelengthRange{400, 500});

    SpectralFunction const dark = held.with_outside(Outside::zero);
    CHECK(dark.at(399.999) == 0);
    CHECK(dark.at(500.001) == 0);
    CHECK(dark.at(400) == 1);
    CHECK(dark.at(500) == Approx(-1).epsilon(1e-15));

    SpectralFunction const line = held.with_outside(Outside::extrapolate);
    CHECK(line.at(400 - 10.5) == Approx(0).margin(1e-14));
    CHECK(line.at(500 + 89.5) == Approx(-4).epsilon(1e-14));
    for (Outside o : {Outside::hold, Outside::extrapolate}) CHECK(table({500}, {3}, o).at(600) == 3);
}

TEST_CASE("a stepped table is constant on each step", "[unit]") {
    SpectralFunction const steps(TabulatedShape{{400, 450, 470}, {2, 5}, true}, Outside::zero);
    CHECK(steps.at(400) == 2);
    CHECK(steps.at(449.999) == 2);
    CHECK(steps.at(450) == 5);
    CHECK(steps.at(470) == 5);
    CHECK(steps.at(470.1) == 0);
    CHECK(steps.integral(visible_range) == Approx(2 * 50 + 5 * 20).epsilon(1e-14));
}

// Closed form per piece: (integral of (a + bx)(c + dx)). A trapezoid rule at 1 nm fails by 2e-6, one at 5 nm by far
// more.
TEST_CASE("the integral of two piecewise linear functions is exact", "[law]") {
    SpectralFunction const f = table({400.25, 431, 433.5, 700}, {0, 7, 1, 3}, Outside::zero);
    SpectralFunction const g = table({390, 432.2, 600, 650.75}, {2, -1, 4, 0}, Outside::hold);
    std::vector<double> const knots{400.25, 431, 432.2, 433.5, 600, 650.75, 700};
    double expected = 0;
    for (std::size_t i = 0; i + 1 < knots.size(); ++i) {
        double const h = knots[i + 1] - knots[i];
        double const f0 = f.at(knots[i]), f1 = f.at(knots[i + 1]), g0 = g.at(knots[i]), g1 = g.at(knots[i + 1]);
        expected += h / 6 * (2 * f0 * g0 + f0 * g1 + f1 * g0 + 2 * f1 * g1);
    }
    CHECK(f.integral({360, 830}, g) == Approx(expected).epsilon(1e-13));
    CHECK(g.integral({360, 830}, f) == Approx(expected).epsilon(1e-13));
    CHECK(SpectralFunction::constant(3).integral({400.5, 410.75}) == Approx(30.75).epsilon(1e-14));
    CHECK(SpectralFunction::constant(3).integral({500.2, 500.3}) == Approx(0.3).epsilon(1e-12));
}

TEST_CASE("a dispersion formula ends at its range unless it is told to go on", "[unit]") {
    DispersionShape const shape{DispersionShape::Formula::sellmeier, {0, 1.2, 0.01}, {400, 800}};
    auto const closed = [](double L) { return std::sqrt(1 + 1.2 * L * L / (L * L - 0.01)); };
    SpectralFunction const n(shape, Outside::hold), on(shape, Outside::extrapolate);
    CHECK(n.at(550) == Approx(closed(0.55)).epsilon(1e-15));
    CHECK(n.at(300) == Approx(closed(0.4)).epsilon(1e-15));
    CHECK(n.at(900) == Approx(closed(0.8)).epsilon(1e-15));
    CHECK(on.at(300) == Approx(closed(0.3)).epsilon(1e-15));
    CHECK(n.defined_on() == WavelengthRange{400, 800});
}
