// SPDX-License-Identifier: Apache-2.0
// Uplifted RGB: the spectrum has the colour under the space's white, is smooth and bounded, and what has none is told.
#include <catch2/catch.hpp>

#include "base/diagnostics.h"
#include "colour/gamut.h"
#include "colour/lab.h"
#include "colour/observer.h"
#include "colour/rgb_encoding.h"
#include "colour/rgb_to_spectrum.h"
#include "colour/sigmoid_fit.h"
#include "support/eye.h"

using namespace iride;
using test::difference_1976, test::Eye, test::wanted_ratio;

// Fails with a bound of .1 per nm on the slope: six dark reds and magentas of the grid have no such reflectance.
TEST_CASE("a 32 x 32 x 32 grid of sRGB comes back within a CIE 1976 difference of .002", "[law]") {
    constexpr int side = 32;
    Eye const eye(white_light(rgb::rec709.white));
    double most = 0, steepest = 0;
    for (int i = 0; i < side * side * side; ++i) {
        // The encoded grid: half of its points are dark, where the fit is hardest.
        Eigen::Vector3d const rgb = Eigen::Vector3d(i % side, i / side % side, i / side / side).unaryExpr([](double v) {
            return decode(TransferFunction::srgb, v / 31);
        });
        SpectralFunction const s = rgb_to_spectrum(rgb, rgb::rec709, RgbRole::reflectance);
        double before = s.at(300);
        for (double nm = 300; nm <= 1000; nm += 2.5) {
            double const value = s.at(nm);
            if (!(value >= 0 && value <= 1))
                FAIL("reflectance " << value << " at " << nm << " nm of " << rgb.transpose());
            if (nm >= 360 && nm <= 830) steepest = std::max(steepest, std::abs(value - before) / 2.5);
            before = value;
        }
        if (i % 5 == 0 || rgb.maxCoeff() == 1)
            most = std::max(most, difference_1976(eye.ratio(s), wanted_ratio(rgb::rec709, rgb)));
    }
    CHECK(most < .002);
    CHECK(steepest < .2);
}

TEST_CASE("uplifted Rec.2020 and ACEScg colours come back under their own white", "[law]") {
    for (RgbSpace const* space : {&rgb::rec2020, &rgb::acescg, &rgb::display_p3, &rgb::adobe_rgb, &rgb::aces2065_1}) {
        Eye const eye(white_light(space->white));
        // Inside the solid of reflectances; wider than Rec.709: gold under D65 exceeds 1 in red there.
        for (Eigen::Vector3d const& rgb :
             {Eigen::Vector3d(.2, .2, .2), Eigen::Vector3d(.5, .3, .2), Eigen::Vector3d(.1, .3, .25),
              Eigen::Vector3d(.9, .8, .85), Eigen::Vector3d(.02, .03, .06), Eigen::Vector3d(.7, .75, .4)}) {
            INFO(space->name << " " << rgb.transpose());
            SpectralFunction const s = rgb_to_spectrum(rgb, *space, RgbRole::reflectance);
            CHECK(difference_1976(eye.ratio(s), wanted_ratio(*space, rgb)) < .002);
        }
    }
    Eye const eye(white_light(rgb::rec709.white));
    Eigen::Vector3d const gold(1.038, .728, .365);  // in no gamut, but a reflectance's
    SpectralFunction const s = rgb_to_spectrum(gold, rgb::rec709, RgbRole::reflectance);
    CHECK(difference_1976(eye.ratio(s), wanted_ratio(rgb::rec709, gold)) < .002);
}

TEST_CASE("white is exactly 1, exactly the white's spectrum, and greys are constants", "[law]") {
    for (RgbSpace const* space : {&rgb::rec709, &rgb::rec2020, &rgb::acescg}) {
        SpectralFunction const& light = white_light(space->white);
        SpectralFunction const reflectance = rgb_to_spectrum({1, 1, 1}, *space, RgbRole::reflectance),
                               unbounded = rgb_to_spectrum({1, 1, 1}, *space, RgbRole::unbounded),
                               emission = rgb_to_spectrum({1, 1, 1}, *space, RgbRole::emission),
                               grey = rgb_to_spectrum({.25, .25, .25}, *space, RgbRole::reflectance),
                               black = rgb_to_spectrum({0, 0, 0}, *space, RgbRole::reflectance);
        for (double nm = 250; nm < 1000; nm += 7.3) {
            CHECK(reflectance.at(nm) == 1);
            CHECK(unbounded.at(nm) == 1);
            CHECK(emission.at(nm) == light.at(nm));
            CHECK(grey.at(nm) == .25);
            CHECK(black.at(nm) == 0);
        }
    }
}

TEST_CASE("the light of a white has that chromaticity", "[law]") {
    Chromaticity const aces = named_white("ACES");
    Chromaticity const got = to_chromaticity(cie1931_2deg().integrate(white_light(aces)));
    CHECK(got.x == Approx(aces.x).margin(1e-12).epsilon(0));
    CHECK(got.y == Approx(aces.y).margin(1e-12).epsilon(0));
    CHECK(cie1931_2deg().integrate(white_light(aces)).Y == Approx(1).epsilon(1e-12));
    // CIE 15: M1 and M2 of a D65 from its chromaticity give the table of D65, to its printed digits and interpolation.
    SpectralFunction const d65 = white_light(named_white("D65:table"));
    for (double nm = 380; nm <= 780; nm += 10)
        CHECK(d65.at(nm) / d65.at(560) == Approx(unit_d65().at(nm) / unit_d65().at(560)).epsilon(5e-3));
}

// The 1 nm table of the product costs .011, at (0, 0, 1).
TEST_CASE("emission has the colour times the light's, for any strength and saturation", "[law]") {
    for (RgbSpace const* space : {&rgb::rec709, &rgb::acescg, &rgb::rec2020}) {
        VectorDouble const white = to_vector(cie1931_2deg().integrate(white_light(space->white)));
        for (Eigen::Vector3d const& c : {Eigen::Vector3d(1, .05, .05), Eigen::Vector3d(.2, .5, .1),
                                         Eigen::Vector3d(.1, .1, 1), Eigen::Vector3d(30, 40, 5)}) {
            INFO(space->name << " " << c.transpose());
            Xyz const got = cie1931_2deg().integrate(rgb_to_spectrum(c, *space, RgbRole::emission));
            VectorDouble const ratio = to_vector(got).cwiseQuotient(white), wanted = wanted_ratio(*space, c);
            CHECK(difference_1976(ratio / (2 * c.maxCoeff()), wanted / (2 * c.maxCoeff())) < .02);
        }
    }
}

TEST_CASE("beyond the observer's range a reflectance goes on and an emission is its light's", "[law]") {
    SpectralFunction const s = rgb_to_spectrum({.6, .3, .2}, rgb::rec709, RgbRole::reflectance);
    CHECK(s.outside() == Outside::extrapolate);
    CHECK(s.defined_on() == visible_range);
    CHECK(s.at(359.9) == Approx(s.at(360)).margin(1e-3));
    CHECK(s.at(850) > s.at(830));  // a red goes on into the infrared
    CHECK(s.with_outside(Outside::hold).at(850) == s.at(830));
    SpectralFunction const e = rgb_to_spectrum({.6, .3, .2}, rgb::rec709, RgbRole::emission);
    CHECK(e.at(330) > 0);
    CHECK(e.defined_on() == unit_d65().defined_on());
}

TEST_CASE("a colour that nothing smooth has is refused with the nearest one", "[input]") {
    using Catch::Contains;
    auto const refused = [](Eigen::Vector3d const& rgb, RgbSpace const& space, RgbRole role) {
        try {
            rgb_to_spectrum(rgb, space, role);
        } catch (InputError const& error) {
            return std::string(error.what());
        }
        return std::string("accepted");
    };
    double const nan = std::numeric_limits<double>::quiet_NaN();
    CHECK_THAT(refused({0, 1, 0}, rgb::rec2020, RgbRole::reflectance),
               Contains("no smooth reflectance has the colour (0, 1, 0) of linear Rec2020; the nearest found is (") &&
                   Contains("CIE 1976 difference"));
    for (Eigen::Vector3d const& rgb : {Eigen::Vector3d(1.2, 1.2, 1.2), Eigen::Vector3d(-1, -1, -1),
                                       Eigen::Vector3d(-.2, .1, .1), Eigen::Vector3d(1.1, 1, 1)})
        CHECK_THAT(refused(rgb, rgb::rec709, RgbRole::reflectance), Contains("the nearest found is"));
    CHECK_THAT(refused({0, 0, -1}, rgb::rec709, RgbRole::emission), Contains("no smooth spectrum has the colour"));
    CHECK_THAT(refused({0, 1, 0}, rgb::aces2065_1, RgbRole::emission), Contains("no smooth spectrum has the colour"));
    CHECK_THAT(refused({nan, 0, 0}, rgb::rec709, RgbRole::emission), Contains("but a colour is finite"));
    CHECK_THAT(refused({.5, .5, .5}, rgb::rec709, RgbRole::reflectance), Contains("accepted"));
}

// Out of reach means: beyond the optimal colours, 0 or 1 with two transitions; the nearest of those is found here by
// trying them all. Fails (13.2 against 8.3, say) with the first fit instead of the best.
TEST_CASE("the nearest colour is hardly farther than the nearest optimal colour", "[law]") {
    TristimulusWeights const weights(white_light(rgb::rec2020.white), cie1931_2deg());
    VectorDouble const white = to_vector(weights.white());
    SigmoidFitter const fitter(white_light(rgb::rec2020.white), cie1931_2deg());
    for (Eigen::Vector3d const& rgb : {Eigen::Vector3d(.0021, .811, .9916), Eigen::Vector3d(0, 1, 0),
                                       Eigen::Vector3d(.926, .0916, .81), Eigen::Vector3d(.0084, .9016, .0696)}) {
        VectorDouble const wanted = wanted_ratio(rgb::rec2020, rgb);
        double least = 1e9;
        for (double from = 360; from <= 830; from += 2)
            for (double to = 360; to <= 830; to += 2)
                least = std::min(
                    least, difference_1976(to_vector(optimal_colour(from, to, weights)).cwiseQuotient(white), wanted));
        double const found = fitter.nearest(wanted).difference;
        INFO(rgb.transpose() << ": " << found << ", optimal " << least);
        CHECK(found > least - .5);   // steps of 2 nm miss the very best
        CHECK(found < least + 1.5);  // slopes of 5 nm instead of steps
    }
}

TEST_CASE("the nearest colour of a too bright grey is white", "[law]") {
    try {
        rgb_to_spectrum({1.1, 1.1, 1.1}, rgb::rec709, RgbRole::reflectance);
        FAIL("accepted");
    } catch (InputError const& error) {
        double r, g, b, d;
        std::string const text = error.what();
        REQUIRE(std::sscanf(text.substr(text.find("found is")).c_str(),
                            "found is (%lf, %lf, %lf), CIE 1976 difference %lf", &r, &g, &b, &d) == 4);
        CHECK(std::min({r, g, b}) > .98);
        CHECK(std::max({r, g, b}) <= 1.001);
        double const least = difference_1976(VectorDouble::Ones(), VectorDouble::Constant(1.1));  // to white itself
        CHECK(d >= least - .01);
        CHECK(d < least + .2);
    }
}
