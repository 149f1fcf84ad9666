// SPDX-License-Identifier: Apache-2.0
// Round trips XYZ -> space -> XYZ over the spectral solid: 1e-12 relative to the largest of X, Y, Z.
#include <catch2/catch.hpp>
#include <cmath>
#include <random>

#include "base/diagnostics.h"
#include "colour/cie_space.h"
#include "colour/lch.h"
#include "colour/observer.h"

using namespace iride;

namespace {

double relative_error(Xyz const& a, Xyz const& b) {
    double const scale = to_vector(b).cwiseAbs().maxCoeff(),
                 error = (to_vector(a) - to_vector(b)).cwiseAbs().maxCoeff();
    return scale == 0 ? error : error / scale;
}

Xyz there_and_back(CieSpace const& space, Xyz const& c, Xyz const& white) {
    return space.to_xyz(space.from_xyz(c, white), white);
}

}  // namespace

// Lightness by way of f(t) = 116 (f - 16/116), as it is written in the standard, loses four digits near black.
TEST_CASE("every CIE space brings the spectral solid back", "[law]") {
    Xyz const white = to_xyz(Chromaticity{.3127, .3290}, 1);
    std::mt19937 random(1);
    std::uniform_real_distribution<double> uniform(0, 1);
    for (CieSpace const& space : cie_spaces()) {
        double worst = 0;
        for (int nm = 360; nm <= 830; ++nm)
            for (double scale : {1e-9, 1e-4, .01, .1, 1.0, 50.0})
                for (double mixed : {0.0, .3, .99}) {
                    Xyz const c = scale * (mixed * white + (1 - mixed) * cie1931_2deg().at(nm));
                    worst = std::max(worst, relative_error(there_and_back(space, c, white), c));
                }
        for (int i = 0; i < 20000; ++i) {  // mixtures of three monochromatic lights
            Xyz c;
            for (int j = 0; j < 3; ++j) c = c + uniform(random) * cie1931_2deg().at(360 + 470 * uniform(random));
            worst = std::max(worst, relative_error(there_and_back(space, c, white), c));
        }
        INFO(space.name << " " << worst);
        CHECK(worst < 1e-12);
    }
}

TEST_CASE("black, white and negative values go there and back", "[law]") {
    Xyz const white = to_xyz(Chromaticity{.3457, .3585}, 1);
    for (CieSpace const& space : cie_spaces()) {
        INFO(space.name);
        CHECK(relative_error(there_and_back(space, {}, white), {}) == 0);
        CHECK(relative_error(there_and_back(space, white, white), white) < 1e-14);
        for (Xyz const& c : {Xyz{-.01, -.02, -.005}, Xyz{.3, .2, -.01}, Xyz{-.1, .4, .2}, Xyz{.1, -.02, .3}})
            CHECK(relative_error(there_and_back(space, c, white), c) < 1e-12);
    }
    CHECK(find_cie_space("xyY")->from_xyz({}, white)[0] == Approx(.3457));
}

TEST_CASE("L*u*v* is the published triple", "[law]") {
    Luv const c = to_luv(Xyz{.20654008, .12197225, .05136952}, to_xyz(Chromaticity{.3127, .3290}, 1));
    CHECK(c.L == Approx(41.52787529).margin(1e-7).epsilon(0));
    CHECK(c.u == Approx(96.83626054).margin(1e-7).epsilon(0));
    CHECK(c.v == Approx(17.75210149).margin(1e-7).epsilon(0));
}

TEST_CASE("L* has its closed forms: 8 at 216/24389, 100 at white, odd line through 0", "[law]") {
    CHECK(lightness(216.0 / 24389) == Approx(8).epsilon(1e-14));
    CHECK(lightness(1) == Approx(100).epsilon(1e-15));
    CHECK(lightness(-.001) == Approx(-24389 / 27.0 * .001).epsilon(1e-14));
    CHECK(lightness(.18418651851244416) == Approx(50).epsilon(1e-14));  // (66/116)^3
}

TEST_CASE("hues are angles from 0 to below 360", "[unit]") {
    CHECK(hue_deg(0, 0) == 0);
    CHECK(hue_deg(-1, 0) == Approx(180));
    CHECK(hue_deg(0, -1) == Approx(270));
    CHECK(hue_deg(1, -1e-300) < 360);
}

TEST_CASE("what is no colour is refused", "[input]") {
    Xyz const white = to_xyz(Chromaticity{.3127, .3290}, 1);
    auto const refuse = [&](char const* space, CieSpace::Triple const& t, char const* message) {
        INFO(space);
        CHECK_THROWS_WITH(checked_xyz(*find_cie_space(space), t, white, "line 3"), Catch::Contains(message));
    };
    refuse("XYZ", {NAN, 0, 0}, "finite numbers are wanted");
    refuse("Lab", {50, INFINITY, 0}, "line 3");
    refuse("xyY", {.3, 0, 1}, "no colour in xyY");
    refuse("uvY", {.2, 0, .5}, "no colour in uvY");
    refuse("XYZ", {.1, -.2, .3}, "not negative");
    refuse("Lab", {50, -300, 0}, "not negative");
    CHECK(find_cie_space("xyy") == nullptr);
}
