// SPDX-License-Identifier: Apache-2.0
// The shipped config is what the derived matrices make of it, OpenColorIO accepts it, and its HDR views are HDR.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstdlib>
#include <sstream>

#include "colour/colour_config.h"
#include "colour/shipped_config.h"
#include "support/files.h"

using namespace iride;

namespace {

std::filesystem::path const shipped = std::filesystem::path(IRIDE_SOURCE_DIR) / "data/ocio/config.ocio";

// Words between blanks, brackets and commas.
std::vector<std::string> words(std::string text) {
    for (char const separator : {'[', ']', ',', '{', '}'}) std::ranges::replace(text, separator, ' ');
    std::istringstream in(text);
    std::vector<std::string> all;
    for (std::string word; in >> word;) all.push_back(word);
    return all;
}

// The perceptual quantiser of [SMPTE ST 2084:2014, eq. 5.2], cd/m^2 to signal.
double pq(double luminance) {
    double const y = std::pow(luminance / 10000, 0.1593017578125);
    return std::pow((0.8359375 + 18.8515625 * y) / (1 + 18.6875 * y), 78.84375);
}

std::array<float, 3> through(ColourTransform const& transform, std::array<float, 3> colour) {
    transform.apply(colour);
    return colour;
}

}  // namespace

// Numbers to 1e-14, since another processor may contract products differently. Fails for a matrix digit edited by hand.
TEST_CASE("the shipped config is the one that is derived", "[unit]") {
    std::vector<std::string> const written = words(test::content(shipped)), derived = words(shipped_config());
    REQUIRE(written.size() == derived.size());
    for (std::size_t i = 0; i < written.size(); ++i) {
        if (written[i] == derived[i]) continue;
        char* end = nullptr;
        double const number = std::strtod(written[i].c_str(), &end);
        INFO(written[i] << " in the file, " << derived[i] << " derived; run scripts/ocio_config");
        REQUIRE(*end == 0);
        double const wanted = std::stod(derived[i]);
        CHECK(std::abs(number - wanted) < 1e-14 * std::max(1.0, std::abs(wanted)));
    }
}

TEST_CASE("ociocheck passes the shipped config, which names no file", "[unit]") {
    CHECK(std::system(("ociocheck --iconfig " + shipped.string() + " > /dev/null").c_str()) == 0);
    CHECK(test::content(shipped).find("FileTransform") == std::string::npos);
}

TEST_CASE("every view of every display shows white as white", "[law]") {
    ColourConfig const config(shipped);
    REQUIRE(config.displays().size() == 6);
    for (std::string const& display : config.displays())
        for (std::string const& view : config.views(display)) {
            auto const grey = through(config.to_display(display, view), {.18f, .18f, .18f});
            INFO(display << ", " << view);
            constexpr float same = 2e-4f;  // of the signal: the tables of OpenColorIO's ACES rendering
            CHECK(std::abs(grey[0] - grey[1]) < same);
            CHECK(std::abs(grey[2] - grey[1]) < same);
            CHECK(grey[1] > .1f);
        }
}

// ACES HDR renderings put a grey card at 15 cd/m^2 and end at the display's peak. Fails when an SDR rendering (grey at
// 10 cd/m^2, peak at 100) stands behind the view's name.
TEST_CASE("HDR views put grey at 15 cd/m^2 and end at their peak", "[law]") {
    ColourConfig const config(shipped);
    for (double peak : {1000., 2000., 4000.}) {
        ColourTransform const view =
            config.to_display("Rec.2100 PQ", "ACES HDR " + std::to_string(static_cast<int>(peak)) + " nit");
        INFO(peak);
        constexpr double signal = 2e-3;  // a tenth of a stop at grey
        CHECK(static_cast<double>(through(view, {.18f, .18f, .18f})[1]) == Approx(pq(15)).margin(signal));
        CHECK(static_cast<double>(through(view, {6e4f, 6e4f, 6e4f})[1]) == Approx(pq(peak)).margin(signal));
    }
    // Hybrid log-gamma: signal 1 is the peak of the 1000 cd/m^2 display.
    ColourTransform const hlg = config.to_display("Rec.2100 HLG", "ACES HDR 1000 nit");
    CHECK(static_cast<double>(through(hlg, {6e4f, 6e4f, 6e4f})[1]) == Approx(1).margin(2e-3));
    // As it is: diffuse white at 100 cd/m^2.
    ColourTransform const plain = config.to_display("Rec.2100 PQ", "Un-tone-mapped");
    CHECK(static_cast<double>(through(plain, {1, 1, 1})[1]) == Approx(pq(100)).margin(1e-5));
}

TEST_CASE("a picture's pixels are the same bits for any number of threads and any size", "[law]") {
    ColourConfig const config(shipped);
    for (ColourTransform const& transform :
         {config.between("ACEScg", "CIE Luv (D50)"), config.to_display("sRGB", "ACES SDR")})
        for (std::size_t pixels : {0u, 1u, 511u, 512u, 513u, 32768u, 32769u, 100003u}) {
            std::vector<float> picture(3 * pixels);
            for (std::size_t i = 0; i < picture.size(); ++i)
                picture[i] = static_cast<float>(i * 7919 % 10007) / 5000.0f;
            std::vector<float> one = picture, two = picture, alone = picture;
            transform.apply(one, 1);
            transform.apply(two, 2);
            CHECK(one == two);
            for (std::size_t i = 0; i < picture.size(); i += 3 * 997)
                transform.apply(std::span(alone).subspan(i, 3), 1);
            for (std::size_t i = 0; i < picture.size(); i += 3 * 997) CHECK(alone[i + 1] == one[i + 1]);
        }
}
