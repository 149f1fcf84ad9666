// SPDX-License-Identifier: Apache-2.0
// White points of CIE 15, and what the tables of the D series and of A say against their formulas.
#include <catch2/catch.hpp>

#include "base/diagnostics.h"
#include "colour/illuminant.h"
#include "colour/tristimulus.h"

using namespace iride;

namespace {

void check_white(char const* light, char const* eye, double x, double y, double margin) {
    Chromaticity const c = to_chromaticity(xyz_of_light(illuminant(light), observer(eye)));
    INFO(light << " " << eye << ": " << c.x << " " << c.y);
    CHECK(c.x == Approx(x).margin(margin).epsilon(0));
    CHECK(c.y == Approx(y).margin(margin).epsilon(0));
}

}  // namespace

TEST_CASE("white points are those of CIE 15 to 5e-5", "[law]") {
    check_white("A", "cie1931_2deg", .44758, .40745, 5e-5);
    check_white("C", "cie1931_2deg", .31006, .31616, 5e-5);
    check_white("D50", "cie1931_2deg", .34567, .35851, 5e-5);
    check_white("D55", "cie1931_2deg", .33243, .34744, 5e-5);
    check_white("D65", "cie1931_2deg", .31272, .32903, 5e-5);
    check_white("D75", "cie1931_2deg", .29903, .31488, 5e-5);
    check_white("D65", "cie1964_10deg", .31382, .33100, 5e-5);
    check_white("E", "cie1931_2deg", .333314, .333288, 5e-7);
}

// (C and the LED lamps too: interpolated to 1 nm they miss the published figures by 1e-4 to 2e-4.)
// Interpolating the table to 1 nm instead would give y = .37529.
TEST_CASE("lamps with lines are summed at their own 5 nm", "[law]") {
    check_white("FL2", "cie1931_2deg", .37207, .37512, 5e-6);
    check_white("FL7", "cie1931_2deg", .3129, .3292, 1e-4);  // CIE 15:2018, table 10.1, four digits
    check_white("FL11", "cie1931_2deg", .3805, .3769, 1e-4);
    check_white("HP1", "cie1931_2deg", .5330, .4150, 1e-4);
    check_white("HP5", "cie1931_2deg", .3776, .3713, 1e-4);
    SpectralFunction const lamp = illuminant("FL2");
    auto table = std::get<TabulatedShape>(lamp.shape());
    REQUIRE(table.summation == Summation::tabulated);
    table.summation = Summation::interpolated;
    Xyz const interpolated = xyz_of_light(SpectralFunction(table, Outside::zero), cie1931_2deg());
    CHECK(to_chromaticity(interpolated).y == Approx(.37529).margin(1e-5).epsilon(0));
}

TEST_CASE("LED illuminants have their CIE chromaticities", "[law]") {  // CIE 15:2018, table 12.1, four digits
    check_white("LED-B1", "cie1931_2deg", .4560, .4078, 1e-4);
    check_white("LED-B3", "cie1931_2deg", .3756, .3723, 1e-4);
    check_white("LED-B5", "cie1931_2deg", .3118, .3236, 1e-4);
    check_white("LED-RGB1", "cie1931_2deg", .4557, .4211, 1e-4);
}

TEST_CASE("the matching functions sum to the CIE's figures", "[law]") {
    double sum = 0;
    for (int nm = 360; nm <= 830; ++nm) sum += cie1931_2deg().at(nm).Y;
    CHECK(sum == Approx(106.8569171).margin(5e-8).epsilon(0));
    CHECK(xyz_of_light(SpectralFunction::constant(1), cie1931_2deg()).Y == Approx(1).epsilon(1e-14));
}

// CIE 15 states the tables of D50, D55, D75 as this formula with M1, M2 to three decimals; without the rounding
// they are missed by up to .03.
TEST_CASE("the tables of the D series are the formula at their temperature", "[law]") {
    struct Row {
        char const* name;
        DefinedTemperature temperature;
        double margin;
    };
    for (Row const& row :
         {Row{"D50", d50_temperature, .0051}, {"D55", d55_temperature, .0051}, {"D75", d75_temperature, .0051}}) {
        SpectralFunction const table = illuminant(row.name);
        SpectralFunction const formula = daylight_illuminant(row.temperature.on_scale_of(c2_its90));
        for (int nm = 300; nm <= 780; nm += 5) {
            INFO(row.name << " at " << nm);
            CHECK(formula.at(nm) == Approx(table.at(nm)).margin(row.margin).epsilon(0));
        }
    }
    CHECK(d65_temperature.on_scale_of(c2_its90) == Approx(6503.6).margin(.05));
    Chromaticity const d65 = daylight_chromaticity(d65_temperature.on_scale_of(c2_its90));
    CHECK(d65.x == Approx(.31272).margin(2e-5).epsilon(0));
    CHECK(d65.y == Approx(.32903).margin(1e-4).epsilon(0));
}

// Fails with 2856 K on today's c2 (2855.50), or with 2848 K.
TEST_CASE("illuminant A is Planck's law with the c2 of its definition", "[law]") {
    SpectralFunction const table = illuminant("A"), formula = illuminant_a();
    for (int nm = 300; nm <= 780; nm += 5)
        CHECK(formula.at(nm) == Approx(table.at(nm)).epsilon(1e-5));  // six digits in the table
}

TEST_CASE("an illuminant out of range or unknown is refused with what is allowed", "[input]") {
    CHECK_THROWS_WITH(daylight_illuminant(3999), Catch::Contains("allowed is 4000 .. 25000 K"));
    CHECK_THROWS_WITH(illuminant("daylight:nan"), Catch::Contains("4000 .. 25000"));
    CHECK_THROWS_WITH(illuminant("blackbody:warm"), Catch::Contains("a number of kelvins is wanted"));
    CHECK_THROWS_WITH(illuminant("blackbody:-1"), Catch::Contains("allowed is above 0"));
    CHECK_THROWS_WITH(illuminant("D66"), Catch::Contains("did you mean 'D65'"));
    CHECK_THROWS_WITH(illuminant("Au"), Catch::Contains("no spectral power"));
    CHECK_THROWS_WITH(observer("cie1931"), Catch::Contains("cie1931_2deg"));
}
