// SPDX-License-Identifier: Apache-2.0
// Dominant wavelength, purity, correlated temperature: inverted from stimuli of which they are known by construction.
#include <catch2/catch.hpp>
#include <cmath>

#include "base/diagnostics.h"
#include "colour/description.h"
#include "colour/illuminant.h"

using namespace iride;

namespace {

Chromaticity mixed(Chromaticity const& a, Chromaticity const& b, double t) {
    return {a.x + t * (b.x - a.x), a.y + t * (b.y - a.y)};
}
Chromaticity constexpr d65{.31272, .32903};

}  // namespace

// Interpolating the wavelength linearly along the chord misses by up to .1 nm between 480 and 500 nm.
TEST_CASE("a monochromatic light mixed with white has its wavelength and its purity", "[law]") {
    for (std::string const& name : observer_names()) {
        SpectralLocus const locus(observer(name));
        for (double nm = 425.3; nm < 660; nm += 3.7)
            for (double purity : {1.0, .5, 1e-3}) {
                Chromaticity const pure = to_chromaticity(observer(name).at(nm));
                auto const got = dominant_wavelength(mixed(d65, pure, purity), d65, locus);
                INFO(name << " " << nm << " " << purity);
                REQUIRE(got.dominant_nm.has_value());
                CHECK(*got.dominant_nm == Approx(nm).margin(1e-6 / purity).epsilon(0));
                CHECK(got.excitation_purity == Approx(purity).epsilon(1e-6));
            }
    }
}

TEST_CASE("a purple has no dominant wavelength but the complementary one of its opposite", "[law]") {
    SpectralLocus const locus(cie1931_2deg());
    Chromaticity const green = to_chromaticity(cie1931_2deg().at(530));
    auto const got = dominant_wavelength(mixed(d65, green, -.2), d65, locus);
    CHECK(!got.dominant_nm);
    CHECK(got.complementary_nm.value() == Approx(530).margin(1e-6));
    auto const back = dominant_wavelength(green, d65, locus);
    CHECK(back.dominant_nm.value() == Approx(530).margin(1e-9));
    CHECK(!back.complementary_nm);
    // On the line of purples itself the purity is 1.
    Chromaticity const purple = mixed(locus.points().front(), locus.points().back(), .4);
    CHECK(dominant_wavelength(purple, d65, locus).excitation_purity == Approx(1).epsilon(1e-12));
}

// Published examples of an independent implementation, to its whole nanometre.
TEST_CASE("dominant wavelengths agree with an independent implementation", "[law]") {
    SpectralLocus const locus(cie1931_2deg());
    Chromaticity const white{.3127, .3290};
    auto const red = dominant_wavelength({.54369557, .32107944}, white, locus);
    CHECK(red.dominant_nm.value() == Approx(616).margin(.5).epsilon(0));
    CHECK(red.complementary_nm.value() == Approx(492).margin(.5).epsilon(0));
    CHECK(red.excitation_purity == Approx(.622885671878446).margin(2e-5).epsilon(0));
    auto const purple = dominant_wavelength({.37605506, .24452225}, white, locus);
    CHECK(!purple.dominant_nm);
    CHECK(purple.complementary_nm.value() == Approx(509).margin(.5).epsilon(0));
    CHECK(purple.excitation_purity == Approx(.438347859215887).margin(1e-4).epsilon(0));
}

TEST_CASE("the white has no dominant wavelength, a white outside the locus is refused", "[input]") {
    SpectralLocus const locus(cie1931_2deg());
    auto const got = dominant_wavelength(d65, d65, locus);
    CHECK(!got.dominant_nm);
    CHECK(!got.complementary_nm);
    CHECK(got.excitation_purity == 0);
    CHECK_THROWS_WITH(dominant_wavelength(d65, {.8, .1}, locus), Catch::Contains("outside the spectral locus"));
    CHECK_THROWS_AS(dominant_wavelength({NAN, NAN}, d65, locus), InputError);
    CHECK(locus.contains(d65));
    CHECK(!locus.contains({.1, .1}));
    CHECK(!locus.contains({NAN, .3}));
}

// Moved off the locus at right angles by Duv, the temperature stays. McCamy's cubic misses by 1 K already at 6500 K.
TEST_CASE("correlated temperature and Duv are found to 1e-3 K from 1000 to 100000 K", "[law]") {
    PlanckianLocus const locus(cie1931_2deg());
    for (double T = 1000; T <= 100000; T *= 1.0501)
        for (double duv : {0.0, .003, -.01, .03, -.03}) {
            double const step = T * 1e-4;
            Uv1960 const p = locus.at(T), before = locus.at(T - step), after = locus.at(T + step);
            double const du = after.u - before.u, dv = after.v - before.v, length = std::hypot(du, dv);
            double const up = du < 0 ? 1 : -1;  // the normal that points to larger v
            auto const got = locus.nearest({p.u + up * dv / length * duv, p.v - up * du / length * duv});
            INFO(T << " K, Duv " << duv);
            if (T <= 1000 && !got) continue;
            REQUIRE(got.has_value());
            CHECK(got->cct_K == Approx(T).margin(1e-3).epsilon(2e-7));  // 2e-7: of the difference quotient above
            CHECK(got->duv == Approx(duv).margin(1e-9));
        }
    CHECK(locus.nearest(locus.at(1000)).value().cct_K == Approx(1000).epsilon(1e-9));
    CHECK(locus.nearest(locus.at(100000)).value().cct_K == Approx(100000).epsilon(1e-9));
    CHECK(!locus.nearest(locus.at(990)));
    CHECK(!locus.nearest(locus.at(120000)));
    CHECK(!locus.nearest({NAN, NAN}));
    CHECK(!locus.nearest({.0, .0}).value_or(CorrelatedTemperature{2000, 1}).is_meaningful());
}

TEST_CASE("a blackbody summed as a light lies on the locus of its own temperature", "[law]") {
    PlanckianLocus const locus(cie1931_2deg());
    for (double T : {1500., 2856., 5000., 6500., 20000.}) {
        Chromaticity const c = to_chromaticity(xyz_of_light(blackbody(T), cie1931_2deg()));
        auto const got = locus.nearest(to_uv_1960(c)).value();
        CHECK(got.cct_K == Approx(T).epsilon(1e-8));
        CHECK(got.duv == Approx(0).margin(1e-10));
    }
    // D65: 6503 to 6504 K, Duv .0032 [Ohno 2014]
    auto const d = locus.nearest(to_uv_1960(d65)).value();
    CHECK(d.cct_K == Approx(6503.5).margin(1));
    CHECK(d.duv == Approx(.0032).margin(5e-5).epsilon(0));
}

TEST_CASE("a description says everything about a spectrum, and what a colour has not is absent", "[law]") {
    ColourDescriber const describe(illuminant("D65"), cie1931_2deg());
    ColourDescription const grey = describe.of_object(SpectralFunction::constant(.5));
    CHECK(grey.xyz.Y == Approx(50).epsilon(1e-12));
    CHECK(grey.lab.a == Approx(0).margin(1e-10));
    CHECK(grey.luv.u == Approx(0).margin(1e-10));
    CHECK(!grey.dominant_wavelength_nm);
    CHECK(grey.excitation_purity == 0);
    CHECK(grey.cct_K.value() == Approx(6503.5).margin(1.5));
    ColourDescription const black = describe.of_object(SpectralFunction::constant(0));
    CHECK(!black.xy);
    CHECK(!black.cct_K);
    CHECK(black.lab.L == 0);
    ColourDescription const lamp = describe.of_light(illuminant("A").scaled(7));
    CHECK(lamp.xyz.Y == Approx(100).epsilon(1e-13));
    CHECK(lamp.cct_K.value() == Approx(2855.5).margin(1));
    CHECK(lamp.dominant_wavelength_nm.value() == Approx(583).margin(2));
}

TEST_CASE("a reflectance in percent, or outside the observer's domain, is refused", "[input]") {
    ColourDescriber const describe(illuminant("D65"), cie1931_2deg());
    auto const factor = [](std::vector<double> nm, std::vector<double> value) {
        return SpectralFunction(TabulatedShape{std::move(nm), std::move(value)}, Outside::hold, "patch");
    };
    CHECK_THROWS_WITH(describe.of_object(factor({400, 700}, {3, 87})),
                      Catch::Contains("values up to 87: a reflectance is 0..1, is this percent?"));
    CHECK_THROWS_WITH(describe.of_object(factor({400, 700}, {.5, -.5})), Catch::Contains("down to -0.5"));
    CHECK_THROWS_WITH(describe.of_object(factor({900, 1000}, {.5, .5})), Catch::Contains("none is within"));
}
