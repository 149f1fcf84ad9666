// SPDX-License-Identifier: Apache-2.0
// RGB spaces with their curves: conversions between any two, through XYZ, and what names mean.
#include <catch2/catch.hpp>
#include <chrono>

#include "base/diagnostics.h"
#include "colour/rgb_encoding.h"

using namespace iride;

namespace {

// Colours inside and outside the gamut, of either sign.
std::vector<VectorDouble> const colours{{0, 0, 0},     {1, 1, 1},      {.2, .5, .1},     {1, 0, 0},
                                        {-.1, .7, .3}, {.01, .9, 1.2}, {.003, .004, .5}, {2, -.5, .25}};

}  // namespace

TEST_CASE("converting to any RGB space and back is the identity to 1e-12", "[law]") {
    for (RgbEncoding const& a : rgb_encodings())
        for (RgbEncoding const& b : rgb_encodings())
            for (VectorDouble const& c : colours) {
                // In linear light: the curve of AdobeRGB is infinitely steep at 0, that of BT.709 has a gap.
                VectorDouble const start = c.unaryExpr([&](double v) { return encode(a.transfer, v); });
                VectorDouble const again = RgbConversion(b, a)(RgbConversion(a, b)(start));
                VectorDouble const linear = again.unaryExpr([&](double v) { return decode(a.transfer, v); });
                INFO(a.name << " by " << b.name << " of " << c.transpose());
                CHECK((linear - c).cwiseAbs().maxCoeff() < 1e-12 * std::max(1.0, 10 * c.norm()));
            }
}

TEST_CASE("white is white in every space, under every white", "[law]") {
    for (RgbEncoding const& a : rgb_encodings()) {
        for (RgbEncoding const& b : rgb_encodings())
            CHECK((RgbConversion(a, b)(VectorDouble::Ones()) - VectorDouble::Ones()).cwiseAbs().maxCoeff() < 1e-14);
        Chromaticity const d50 = named_white("D50");
        VectorDouble const white = to_vector(to_xyz(d50, 1));
        CHECK((RgbConversion::to_xyz(a, d50)(VectorDouble::Ones()) - white).cwiseAbs().maxCoeff() < 1e-14);
        CHECK((RgbConversion::from_xyz(d50, a)(white) - VectorDouble::Ones()).cwiseAbs().maxCoeff() < 1e-14);
    }
}

// IEC 61966-2-1, four digits.
TEST_CASE("sRGB colours have their published XYZ", "[law]") {
    RgbConversion const to = RgbConversion::to_xyz(rgb_encoding("sRGB"), named_white("D65"));
    VectorDouble const red = to({1, 0, 0}), grey = to({.5, .5, .5});
    CHECK((red - VectorDouble(.4124, .2126, .0193)).cwiseAbs().maxCoeff() < 6e-5);
    CHECK(grey[1] == Approx(.21404114).margin(1e-8).epsilon(0));
}

// BT.2087-0, annex 1: linear BT.709 to BT.2020, four digits.
TEST_CASE("Rec.709 goes to Rec.2020 by the published matrix", "[law]") {
    RgbConversion const convert(rgb_encoding("linear-sRGB"), rgb_encoding("linear-Rec2020"));
    MatrixDouble published;
    published << .6274, .3293, .0433, .0691, .9195, .0114, .0164, .0880, .8956;
    MatrixDouble derived;
    derived << convert({1, 0, 0}), convert({0, 1, 0}), convert({0, 0, 1});
    CHECK((derived - published).cwiseAbs().maxCoeff() < 6e-5);
}

TEST_CASE("a name means the standard's signal in numbers, linear light in files", "[law]") {
    RgbConversion const encoded(rgb_encoding("linear-sRGB"), rgb_encoding("Rec709"));
    CHECK(encoded({.18, .18, .18})[0] == Approx(.409).margin(5e-4).epsilon(0));
    Chromaticity const d65 = named_white("D65");
    for (char const* name : {"Rec709", "linear-sRGB"})
        CHECK(output_space(name, d65).from_xyz.isApprox(rgb::rec709.from_xyz_matrix(), 1e-15));
    CHECK(output_space("linear-Rec2020", d65).from_xyz == output_space("Rec2020", d65).from_xyz);
    CHECK(output_space("XYZ", d65).rgb == nullptr);
}

TEST_CASE("unknown RGB spaces and encoded outputs are refused with the nearest name", "[input]") {
    CHECK_THROWS_WITH(rgb_encoding("sRBG"), Catch::Contains("unknown RGB space 'sRBG'; did you mean 'sRGB'?"));
    CHECK_THROWS_WITH(rgb_encoding("XYZ"), Catch::Contains("allowed: sRGB, linear-sRGB, Rec709"));
    CHECK_THROWS_WITH(output_space("sRGB", named_white("D65")), Catch::Contains("unknown colour space 'sRGB'"));
}

// A stream of conversions: the target is a million a second on one core, with two curves; here with a margin for a
// busy machine and instrumented builds.
TEST_CASE("a hundred thousand RGB conversions take well under a second", "[law]") {
    RgbConversion const convert(rgb_encoding("sRGB"), rgb_encoding("DisplayP3"));
    VectorDouble sum = VectorDouble::Zero();
    auto const start = std::chrono::steady_clock::now();
    for (int i = 0; i < 100000; ++i) sum += convert({i * 1e-5, .5, 1 - i * 1e-5});
    CHECK(std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count() < 1);
    CHECK(sum.allFinite());
}
