// SPDX-License-Identifier: Apache-2.0
// Tristimulus weights for factors measured at 5, 10 or 20 nm, against the tables of ASTM E308-15 (three decimals,
// Y = 100) and against direct summation at 1 nm.
#include <catch2/catch.hpp>
#include <cmath>

#include "base/diagnostics.h"
#include "base/vector.h"
#include "colour/illuminant.h"
#include "colour/tristimulus.h"
#include "spectral/interpolation.h"

using namespace iride;

namespace {

struct Weight {
    double nm, x, y, z;
};

void check_weights(SpectralFunction const& light, char const* eye, double step, std::vector<Weight> const& wanted) {
    TristimulusWeights const w = TristimulusWeights(light, observer(eye)).at_steps(360, step == 20 ? 820 : 830, step);
    for (Weight const& row : wanted) {
        auto const i = static_cast<std::size_t>((row.nm - 360) / step);
        Xyz const got = 100 * w.weights().at(i);
        INFO(eye << " " << step << " nm at " << row.nm << ": " << got.X << " " << got.Y << " " << got.Z);
        REQUIRE(w.wavelengths_nm()[i] == row.nm);
        CHECK(got.X == Approx(row.x).margin(6e-4).epsilon(0));
        CHECK(got.Y == Approx(row.y).margin(6e-4).epsilon(0));
        CHECK(got.Z == Approx(row.z).margin(6e-4).epsilon(0));
    }
}

// A reflectance with structure of 40 nm, smooth enough for 20 nm measurements.
double wavy(double nm) { return .5 + .3 * std::sin(nm / 40) + .15 * std::cos(nm / 25); }

}  // namespace

// Cubic weights in the outermost intervals too would give .001 more of Z at 360 nm; a bandpass correction changes
// the second decimal.
TEST_CASE("derived weights are the published tables of ASTM E308", "[law]") {
    check_weights(illuminant_a(), "cie1964_10deg", 10,
                  {{390, .002, .000, .008},
                   {400, .025, .003, .110},
                   {440, .964, .156, 4.944},
                   {450, 1.080, .259, 5.806},
                   {500, .022, 2.422, 1.152},
                   {550, 4.336, 8.114, .032},
                   {560, 6.200, 8.758, .001},
                   {600, 12.746, 7.468, 0},
                   {650, 3.887, 1.560, 0},
                   {700, .166, .065, 0}});
    check_weights(illuminant_a(), "cie1964_10deg", 20,
                  {{360, 0, 0, -.001},
                   {380, -.009, -.001, -.041},
                   {400, .060, .005, .257},
                   {440, 1.900, .304, 9.755},
                   {480, .718, 2.146, 6.785},
                   {540, 5.677, 14.461, .196},
                   {560, 12.445, 17.474, .005},
                   {580, 20.554, 17.584, -.003},
                   {600, 25.332, 14.896, 0},
                   {700, .318, .123, 0}});
    check_weights(illuminant("D65"), "cie1931_2deg", 20,
                  {{360, -.001, 0, -.005},
                   {380, -.008, 0, -.039},
                   {400, .179, .002, .829},
                   {440, 6.670, .453, 33.637},
                   {480, 2.213, 2.933, 18.278},
                   {540, 5.767, 18.981, .382},
                   {560, 11.301, 18.863, .068},
                   {600, 17.933, 10.699, .013},
                   {640, 7.057, 2.743, 0},
                   {700, .140, .050, 0}});
}

TEST_CASE("whites are those that ASTM E308 prints under its tables", "[law]") {
    struct Row {
        char const *light, *eye;
        double X, Z;
    };
    for (Row const& row : {Row{"A", "cie1931_2deg", 109.850, 35.585},
                           {"C", "cie1931_2deg", 98.074, 118.232},
                           {"D50", "cie1931_2deg", 96.422, 82.521},
                           {"D55", "cie1931_2deg", 95.682, 92.149},
                           {"D65", "cie1931_2deg", 95.047, 108.883},
                           {"D75", "cie1931_2deg", 94.972, 122.638},
                           {"A", "cie1964_10deg", 111.144, 35.200},
                           {"C", "cie1964_10deg", 97.285, 116.145},
                           {"D50", "cie1964_10deg", 96.720, 81.427},
                           {"D65", "cie1964_10deg", 94.811, 107.304},
                           {"FL2", "cie1931_2deg", 99.186, 67.393},
                           {"FL11", "cie1931_2deg", 100.962, 64.350}}) {
        Xyz const white = 100 * TristimulusWeights(illuminant(row.light), observer(row.eye)).white();
        INFO(row.light << " " << row.eye << ": " << white.X << " " << white.Z);
        CHECK(white.X == Approx(row.X).margin(.02).epsilon(0));
        CHECK(white.Z == Approx(row.Z).margin(.02).epsilon(0));
        CHECK(white.Y == Approx(100).epsilon(1e-13));
    }
}

// A cubic through four points h apart errs by at most 3/128 h^4 times the fourth derivative in its middle interval.
// Linear weights would err by a hundred times as much at 5 nm.
TEST_CASE("weights at 5, 10 and 20 nm agree with the sum at 1 nm as closely as a cubic can", "[law]") {
    TabulatedShape fine;
    for (double nm = 360; nm <= 830; ++nm) fine.nm.push_back(nm), fine.value.push_back(wavy(nm));
    SpectralFunction const factor(fine, Outside::hold);
    double const fourth = .3 / std::pow(40, 4) + .15 / std::pow(25, 4);
    for (char const* light : {"A", "D65", "FL2"}) {
        TristimulusWeights const direct(illuminant(light), cie1931_2deg());
        VectorDouble const wanted = to_vector(direct.of(factor)), white = to_vector(direct.white());
        for (double step : {5., 10., 20.}) {
            TristimulusWeights const coarse = direct.at_steps(360, step == 20 ? 820 : 830, step);
            std::vector<double> values;
            for (double nm : coarse.wavelengths_nm()) values.push_back(wavy(nm));
            double const worst = (to_vector(coarse.of(values)) - wanted).cwiseQuotient(white).cwiseAbs().maxCoeff();
            INFO(light << " " << step << " nm: " << worst);
            CHECK(worst <= 3.0 / 128 * std::pow(step, 4) * fourth);
        }
    }
}

// The wavy factor measured at 10 nm: lines between the points flatten its hills, cubics do not.
TEST_CASE("a table at 10 nm is weighed as measured on request, any other shape as it is", "[law]") {
    TabulatedShape fine, coarse;
    for (int nm = 360; nm <= 830; ++nm) {
        fine.nm.push_back(nm), fine.value.push_back(wavy(nm));
        if (nm % 10 == 0) coarse.nm.push_back(nm), coarse.value.push_back(wavy(nm));
    }
    TristimulusWeights const weights(illuminant("D65"), cie1931_2deg());
    SpectralFunction const measured(coarse, Outside::hold), known(fine, Outside::hold);
    double const exact = weights.of(known).Y;
    CHECK(std::abs(weights.of_measured(measured).Y - exact) < .1 * std::abs(weights.of(measured).Y - exact));
    CHECK(weights.of_measured(known).Y == exact);
    CHECK(weights.of_measured(SpectralFunction::constant(.5)).Y == Approx(.5).epsilon(1e-14));
}

TEST_CASE("a constant factor is that multiple of the white, whatever the range and step", "[law]") {
    TristimulusWeights const direct(illuminant("D50"), cie1931_2deg());
    for (double step : {5.0, 10.0, 20.0}) {
        TristimulusWeights const coarse = direct.at_steps(400, 700, step);
        Xyz const c = coarse.of(std::vector<double>(coarse.wavelengths_nm().size(), .25));
        CHECK((to_vector(c) - .25 * to_vector(direct.white())).norm() < 1e-14);
    }
    CHECK(direct.of(SpectralFunction::constant(1)).Y == Approx(1).epsilon(1e-14));
    CHECK_THROWS_AS(direct.at_steps(400, 705, 10), InputError);
    CHECK_THROWS_AS(direct.at_steps(400, 400, 10), InputError);
    CHECK_THROWS_AS(direct.at_steps(400, 700, 0), InputError);
}

TEST_CASE("a table finer than 1 nm loses no line between whole nanometres", "[law]") {
    // A triangle .2 nm wide at 550.5 nm: a sum over whole nanometres alone would not see it.
    SpectralFunction const line(TabulatedShape{{550.4, 550.5, 550.6}, {0, 1, 0}}, Outside::zero);
    Xyz const c = xyz_of_light(line, cie1931_2deg()), wanted = cie1931_2deg().at(550.5);
    CHECK(c.X / c.Y == Approx(wanted.X / wanted.Y).epsilon(1e-6));
    CHECK(luminance_of(line, cie1931_2deg()) == Approx(683 * .1 * wanted.Y).epsilon(1e-4));
}

TEST_CASE("watts become lumens by 683 lm/W at 555 nm", "[law]") {
    // 1 W/nm over 1 nm at the peak of the 1931 ybar, which is 1 there.
    SpectralFunction const one(TabulatedShape{{554, 555, 556}, {0, 1, 0}}, Outside::zero);
    CHECK(luminance_of(one, cie1931_2deg()) == Approx(683).epsilon(1e-9));
}

// The two values that CIE 167 adds beyond each end reproduce straight lines only.
TEST_CASE("Sprague's polynomial reproduces a cubic inside and a line up to the ends", "[law]") {
    auto const cubic = [](double nm) { return 1 + .01 * nm - 2e-5 * nm * nm + 3e-8 * nm * nm * nm; };
    TabulatedShape t, line;
    for (double nm = 400; nm <= 700; nm += 20) {
        t.nm.push_back(nm), t.value.push_back(cubic(nm));
        line.nm.push_back(nm), line.value.push_back(2 - .002 * nm);
    }
    SpectralFunction const fine = sprague_interpolated(SpectralFunction(t, Outside::hold));
    SpectralFunction const straight = sprague_interpolated(SpectralFunction(line, Outside::hold));
    for (double nm = 440; nm <= 660; ++nm) CHECK(fine.at(nm) == Approx(cubic(nm)).epsilon(1e-12));
    for (double nm = 400; nm <= 700; nm += 20) CHECK(fine.at(nm) == Approx(cubic(nm)).epsilon(1e-12));
    for (double nm = 400; nm <= 700; ++nm) CHECK(straight.at(nm) == Approx(2 - .002 * nm).epsilon(1e-12));
    CHECK_THROWS_WITH(sprague_interpolated(SpectralFunction(TabulatedShape{{1, 2, 4}, {1, 1, 1}}, Outside::hold, "t")),
                      Catch::Contains("equally spaced"));
}

TEST_CASE("a light that gives nothing, or less, is refused", "[input]") {
    auto const light = [](std::vector<double> nm, std::vector<double> value) {
        return SpectralFunction(TabulatedShape{std::move(nm), std::move(value)}, Outside::zero, "lamp");
    };
    CHECK_THROWS_WITH(xyz_of_light(light({400, 700}, {0, 0}), cie1931_2deg()), Catch::Contains("gives Y = 0"));
    CHECK_THROWS_WITH(xyz_of_light(light({1000, 2000}, {1, 1}), cie1931_2deg()),
                      Catch::Contains("defined on 1000 .. 2000 nm"));
    CHECK_THROWS_WITH(TristimulusWeights(light({400, 700}, {1, -1}), cie1931_2deg()), Catch::Contains("is negative"));
}
