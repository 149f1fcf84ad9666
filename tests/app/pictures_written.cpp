// SPDX-License-Identifier: Apache-2.0
// What the program leaves on the disk: an EXR whose header and pixels other programs can trust, and a preview that is
// the view of it.
#include <catch2/catch.hpp>

#include "base/picture.h"
#include "film/preview.h"
#include "spectral/catalogue.h"
#include "support/program.h"
#include "support/scenes.h"

using namespace iride;
using Catch::Matchers::Contains;

namespace {

// The first three channels of a picture as floats (8-bit ones as 0 .. 255), row by row.
std::vector<float> channels_of(std::filesystem::path const& path) {
    Picture picture = read_picture(path, {.least_channels = 3, .most_channels = 3});
    if (picture.integers)
        for (float& v : picture.value) v *= 255;
    return std::move(picture.value);
}

}  // namespace

// L = Le / (1 - rho) = 2 at every wavelength. Of 196608 normal deviates 12.5 are expected beyond 4 sigma, and up to 27
// at a level of 1e-4; beyond 6 sigma there are none. Fails with one per cent of the light lost at each bounce (mean
// 1.98), and with a variance that is half of the true one.
TEST_CASE("every pixel of cube-uniform is 2 within its own error bar", "[law]") {
    test::TemporaryFolder const folder;
    std::string const out = (folder.path() / "cube.exr").string();
    auto const r = test::run_iride("render cube-uniform --spp 64 --colourspace XYZ -o " + out);
    INFO(r.text);
    REQUIRE(r.code == 0);
    CHECK_THAT(r.text, Contains(" 0 samples rejected"));
    XyzPicture const picture = read_exr_as_xyz(out);
    REQUIRE(picture.xyz.pixel.size() == 256 * 256);
    Xyz mean;
    int beyond_4 = 0;
    double worst = 0;
    for (std::size_t i = 0; i < picture.xyz.pixel.size(); ++i) {
        mean = mean + (1.0 / (256 * 256)) * picture.xyz.pixel[i];
        for (double Xyz::*c : {&Xyz::X, &Xyz::Y, &Xyz::Z}) {
            double const z = std::abs(picture.xyz.pixel[i].*c - 2) / std::sqrt(picture.variance.pixel[i].*c);
            beyond_4 += z > 4;
            worst = std::max(worst, z);
        }
    }
    CHECK(beyond_4 <= 27);
    CHECK(worst < 6);
    for (double Xyz::*c : {&Xyz::X, &Xyz::Y, &Xyz::Z}) CHECK(mean.*c == Approx(2).margin(1e-3).epsilon(0));
}

TEST_CASE("exrheader shows what a pipeline wants to know", "[app]") {
    test::TemporaryFolder const folder;
    std::string const scene = folder
                                  .write("grey.json",
                                         R"({ "camera": { "eye": [0,0,-5], "target": [0,0,0], "field_deg": 40 },
               "film": { "size": [8, 8], "exposure": 2, "bands": { "count": 3 } },
               "lights": [{ "type": "environment", "radiance": 1 }] })")
                                  .string();
    std::string const out = (folder.path() / "a.exr").string();
    REQUIRE(test::run_iride("render " + scene + " --spp 5 --seed 123456789012 -o " + out).code == 0);
    auto const header = test::run_command("exrheader " + out);
    INFO(header.text);
    REQUIRE(header.code == 0);
    // ACES S-2014-004; 683 lm/W times 106.857 nm, over the exposure.
    CHECK_THAT(header.text, Contains("chromaticities (type chromaticities):") && Contains("red   (0.713 0.293)") &&
                                Contains("green (0.165 0.83)") && Contains("blue  (0.128 0.044)") &&
                                Contains("white (0.32168 0.33767)"));
    CHECK_THAT(header.text, Contains("whiteLuminance (type float): 36491.6"));
    CHECK_THAT(header.text, Contains("colorInteropID (type string): \"lin_ap1_scene\""));
    CHECK_THAT(header.text, Contains("iride:sceneHash (type string): \"" + load_scene(scene)->hash + "\""));
    CHECK_THAT(header.text, Contains("iride:spp (type int): 5"));
    CHECK_THAT(header.text, Contains("iride:seed (type string): \"123456789012\""));
    CHECK_THAT(header.text, Contains("iride:integrator (type string): \"auto\""));
    CHECK_THAT(header.text, Contains("iride:observer (type string): \"cie1931_2deg\""));
    CHECK_THAT(header.text, Contains("spectralLayoutVersion (type string): \"1.0\"") &&
                                Contains("emissiveUnits (type string): \"W.m^-2.sr^-1\""));
    CHECK_THAT(header.text, Contains("S0.438,333333nm, 32-bit floating-point"));
    CHECK_THAT(header.text, Contains("iride:rejected.not_finite (type string): \"0\""));
}

// A half has 11 bits: rounding to nearest errs by 2^-11, relatively. Fails if colour or bands stay float.
TEST_CASE("a half picture is the float one to half precision", "[app]") {
    test::TemporaryFolder const folder;
    auto const write = [&](bool half) {
        std::string const name = half ? "half" : "float";
        auto const scene =
            folder.write(name + ".json", R"({ "camera": { "eye": [0,0,-5], "target": [0,0,0], "field_deg": 40 },
               "film": { "size": [16, 16], "bands": { "count": 4 }, "half": )" +
                                             std::string(half ? "true" : "false") + R"( },
               "lights": [{ "type": "environment", "radiance": "D65" }],
               "shapes": [{ "type": "sphere", "centre": [0,0,0], "radius": 1, "material": { "type": "conductor", "ior": "Au", "roughness": 0.3 } }] })");
        std::string const out = (folder.path() / (name + ".exr")).string();
        REQUIRE(test::run_iride("render " + scene.string() + " --spp 4 --colourspace XYZ -o " + out).code == 0);
        auto const header = test::run_command("exrheader " + out).text;
        CHECK_THAT(header, Contains(std::string("X, ") + (half ? "16" : "32") + "-bit floating-point"));
        CHECK_THAT(header, Contains("variance.X, 32-bit floating-point"));
        return read_exr_as_xyz(out);
    };
    XyzPicture const exact = write(false), rounded = write(true);
    REQUIRE(rounded.bands.size() == 4);
    constexpr double half_precision = 0x1p-11;
    for (std::size_t i = 0; i < exact.xyz.pixel.size(); ++i) {
        for (double Xyz::*c : {&Xyz::X, &Xyz::Y, &Xyz::Z}) {
            CHECK(rounded.xyz.pixel[i].*c == Approx(exact.xyz.pixel[i].*c).epsilon(half_precision));
            CHECK(rounded.variance.pixel[i].*c == exact.variance.pixel[i].*c);
        }
        for (std::size_t b = 0; b < 4; ++b)
            CHECK(static_cast<double>(rounded.bands[b].second.pixel[i]) ==
                  Approx(exact.bands[b].second.pixel[i]).epsilon(half_precision));
    }
    CHECK(compare(rounded, exact).mse > 0);
}

// Fails for a preview without exposure, without the view, or of the working space's primaries.
TEST_CASE("the preview's pixels are the view of the EXR's", "[app]") {
    test::TemporaryFolder const folder;
    std::string const scene = folder
                                  .write("spheres.json",
                                         R"({ "camera": { "eye": [0,0,-5], "target": [0,0,0], "field_deg": 40 },
               "film": { "size": [24, 16], "exposure": 0.7, "white": "A" },
               "lights": [{ "type": "environment", "radiance": { "data": "A", "luminance_weighted": 1 } }],
               "shapes": [{ "type": "sphere", "centre": [-1,0,0], "radius": 1, "material": { "type": "conductor", "ior": "Cu", "roughness": 0.3 } },
                          { "type": "sphere", "centre": [1,0,0], "radius": 1, "material": { "type": "diffuse", "reflectance": 0.04 } }] })")
                                  .string();
    ColourConfig const config(data_folder() / "ocio" / "config.ocio");
    for (std::string const& view : config.views(config.displays().front())) {
        std::string const exr = (folder.path() / "a.exr").string(), png = (folder.path() / "a.png").string();
        auto const r =
            test::run_iride("render " + scene + " --spp 16 --view '" + view + "' -o " + exr + " --preview " + png);
        INFO(view << ": " << r.text);
        REQUIRE(r.code == 0);
        std::vector<float> wanted = channels_of(exr);
        config.to_display("", view).apply(wanted);
        std::vector<float> const shown = channels_of(png);
        REQUIRE(shown.size() == wanted.size());
        double worst = 0;
        for (std::size_t i = 0; i < shown.size(); ++i)
            worst = std::max(worst, std::abs(static_cast<double>(255 * std::clamp(wanted[i], 0.0f, 1.0f) - shown[i])));
        CHECK(worst < 0.5 + 1e-3);  // rounded to the nearest of 256 steps
    }
}
