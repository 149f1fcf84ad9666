// SPDX-License-Identifier: Apache-2.0
// The CIE spaces of the shipped config, computed by OpenColorIO in float, are CIE's formulas: against double, there and
// back, at the edges of their domain.
#include <Eigen/LU>
#include <catch2/catch.hpp>

#include "base/random.h"
#include "colour/colour_config.h"
#include "colour/difference.h"
#include "colour/lab.h"
#include "colour/observer.h"
#include "colour/reference_space.h"

using namespace iride;

namespace {

double unit(std::uint64_t i, std::uint64_t component) {
    return static_cast<double>(hash_words(i, component) >> 11) * 0x1p-53;
}

// A real colour: three wavelengths between 400 and 700 nm mixed at random, as XYZ with a luminance that favours the
// dark.
VectorDouble real_colour(std::uint64_t i) {
    VectorDouble sum = VectorDouble::Zero();
    for (std::uint64_t k = 0; k < 3; ++k)
        sum += unit(i, 2 * k) * to_vector(cie1931_2deg().at(400 + 300 * unit(i, 2 * k + 1)));
    return sum * (std::pow(unit(i, 6), 3) / sum[1]);
}

std::array<float, 3> through(ColourTransform const& transform, VectorDouble const& colour) {
    std::array<float, 3> c{static_cast<float>(colour[0]), static_cast<float>(colour[1]), static_cast<float>(colour[2])};
    transform.apply(c);
    return c;
}
VectorDouble vector(std::array<float, 3> const& c) { return Eigen::Vector3f(c[0], c[1], c[2]).cast<double>(); }

// The largest CIEDE2000 of a space against double precision, and there and back.
struct Largest {
    double against_double = 0, round_trip = 0;
    double number = 0;  // error relative to the colour's largest number, if that is above 1
    bool finite = true;
};
Largest largest(ColourConfig const& config, std::string const& space_name, std::string const& white, int count) {
    ReferenceSpace const* const space = find_reference_space({space_name}, false);
    REQUIRE(space);
    ColourTransform const there = config.between("ACES2065-1", space_name),
                          back = config.between(space_name, "ACES2065-1");
    MatrixDouble const to_xyz_w =
        bradford_adaptation(named_white("ACES"), named_white(white)) * rgb::aces2065_1.to_xyz_matrix();
    MatrixDouble const from_xyz_w = to_xyz_w.inverse();
    std::vector<float> given, value;
    for (int i = 0; i < count; ++i)
        for (double const v : VectorDouble(from_xyz_w * real_colour(static_cast<std::uint64_t>(i))))
            given.push_back(static_cast<float>(v));
    value = given;
    there.apply(value);
    std::vector<float> again = value;
    back.apply(again);
    Xyz const w = to_xyz(named_white(white), 1);
    auto const lab = [&](VectorDouble const& aces) { return to_lab(to_xyz(VectorDouble(to_xyz_w * aces)), w); };
    Largest result;
    for (std::size_t i = 0; i < given.size(); i += 3) {
        auto const at = [i](std::vector<float> const& v) { return vector({v[i], v[i + 1], v[i + 2]}); };
        Lab const exact = lab(at(given));
        VectorDouble const wanted = space->from_reference(at(given));
        result.finite = result.finite && at(value).allFinite() && at(again).allFinite();
        result.number = std::max(
            result.number, (at(value) - wanted).cwiseAbs().maxCoeff() / std::max(1.0, wanted.cwiseAbs().maxCoeff()));
        result.against_double =
            std::max(result.against_double, delta_e_2000(lab(space->to_reference(at(value))), exact));
        result.round_trip = std::max(result.round_trip, delta_e_2000(lab(at(again)), exact));
    }
    return result;
}

void check_all(int count) {
    ColourConfig const config(std::filesystem::path(IRIDE_SOURCE_DIR) / "data/ocio/config.ocio");
    for (char const* white : {"D65", "D50", "E"})
        for (char const* space : {"XYZ", "uvY", "Luv", "Lab"}) {
            Largest const l = largest(config, std::string("CIE ") + space + " (" + white + ")", white, count);
            INFO(space << " " << white << ": number " << l.number << ", CIEDE2000 " << l.against_double
                       << ", round trip " << l.round_trip);
            CHECK(l.against_double < .002);
            CHECK(l.round_trip < .002);
            CHECK(l.number < 1e-5);  // L*u*v* is a difference of products eight times as large, of floats
            CHECK(l.finite);
        }
}

}  // namespace

// Fails for an offset of .1601 in the curve of L*, and for the fourth digit of a matrix.
TEST_CASE("100000 random real colours agree with double in every CIE space of the config", "[law]") {
    check_all(100000);
}
TEST_CASE("a million random real colours agree with double in every CIE space of the config", "[.long]") {
    check_all(1000000);
}

// The worked example that the documentation of colour-science prints, white xy (.3127, .3290).
TEST_CASE("L*u*v* of the config is what CIE's formula gives for a printed example", "[law]") {
    ColourConfig const config(std::filesystem::path(IRIDE_SOURCE_DIR) / "data/ocio/config.ocio");
    VectorDouble const xyz(.20654008, .12197225, .05136952);
    auto const luv = through(config.between("CIE XYZ (D65)", "CIE Luv (D65)"), xyz);
    CHECK(static_cast<double>(luv[0]) == Approx(41.52787529).margin(1e-4).epsilon(0));
    CHECK(static_cast<double>(luv[1]) == Approx(96.83626054).margin(5e-4).epsilon(0));
    CHECK(static_cast<double>(luv[2]) == Approx(17.75210149).margin(5e-4).epsilon(0));
}

TEST_CASE("black has the white's chromaticity and comes back black", "[law]") {
    ColourConfig const config(std::filesystem::path(IRIDE_SOURCE_DIR) / "data/ocio/config.ocio");
    auto const uvY = through(config.between("ACES2065-1", "CIE uvY (D65)"), VectorDouble::Zero());
    CHECK(uvY[0] == Approx(.19784).margin(2e-5));  // u'n, v'n of (.3127, .3290)
    CHECK(uvY[1] == Approx(.46834).margin(2e-5));
    CHECK(uvY[2] < 1e-30f);
    for (char const* name : {"CIE uvY (D65)", "CIE Luv (D50)", "CIE Lab (E)", "CIE XYZ (E)"}) {
        auto const value = through(config.between("ACES2065-1", name), VectorDouble::Zero());
        auto const back = through(config.between(name, "ACES2065-1"), vector(value));
        INFO(name);
        CHECK(vector(back).norm() < 1e-9);
        if (std::string(name) == "CIE Luv (D50)") CHECK(vector(value).norm() < 1e-4);
    }
}

// What the descriptions in the config say: L*a*b* is CIE's tangent below 0, the others take it as 0. Never NaN.
TEST_CASE("negative XYZ goes on in L*a*b* and counts as zero in u'v'Y and L*u*v*", "[law]") {
    ColourConfig const config(std::filesystem::path(IRIDE_SOURCE_DIR) / "data/ocio/config.ocio");
    VectorDouble const impossible(-.1, .4, -.05), dark(.2, -.1, .3);
    auto const lab = through(config.between("CIE XYZ (D65)", "CIE Lab (D65)"), impossible);
    Lab const exact = to_lab(to_xyz(impossible), to_xyz(named_white("D65"), 1));
    CHECK((vector(lab) - VectorDouble(exact.L, exact.a, exact.b)).cwiseAbs().maxCoeff() < 1e-3);
    auto const uvY = through(config.between("CIE XYZ (D65)", "CIE uvY (D65)"), impossible);
    CHECK(uvY[0] < 1e-30f);
    CHECK(uvY[1] == Approx(9 * .4 / (-.1 + 15 * .4 - .15)).epsilon(1e-6));
    for (char const* name : {"CIE uvY (D65)", "CIE Luv (D65)"}) {
        auto const value = through(config.between("CIE XYZ (D65)", name), dark);
        INFO(name);
        CHECK(vector(value).allFinite());
        CHECK(vector(through(config.between(name, "CIE XYZ (D65)"), vector(value))).allFinite());
    }
}
