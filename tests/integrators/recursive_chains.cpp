// SPDX-License-Identifier: Apache-2.0
// `recursive` against closed forms of chains, cut after any number of generations.
#include <fmt/format.h>

#include <catch2/catch.hpp>

#include "support/agreement.h"
#include "support/scenes.h"

using namespace iride;

namespace {

void check_radiance(Scene const& scene, std::string const& integrator, double expected) {
    INFO(integrator);
    auto const m = test::picture_mean(test::rendered(scene, integrator, {.spp = 512, .seed = 9}));
    constexpr double rounding = 2e-4;
    CHECK(std::abs(m[1].mean - expected) <= 4 * std::sqrt(m[1].variance) + rounding * expected);
    CHECK(std::sqrt(m[1].variance) < 0.005);
}

}  // namespace

// A pane of index 2.5 before a lamp, seen along its normal: with F = (1.5/3.5)^2, each echo inside takes two
// generations more. L = (1-F)^2 (1 + F^2 + F^4 ...).
TEST_CASE("recursive sees a pane's echoes as its closed form, generation by generation", "[law]") {
    auto const scene = test::scene_from(R"({
      "camera": { "type": "orthographic", "eye": [0, 0, -2], "target": [0, 0, 0], "window": 0.001 }, "film": { "size": [8, 8] },
      "shapes": [ { "type": "box", "min": [-5,-5,0], "max": [5,5,0.1], "material": { "type": "dielectric", "ior": 2.5 } },
                  { "type": "quad", "corners": [[-5,-5,1],[-5,5,1],[5,5,1],[5,-5,1]], "material": { "type": "black" }, "emission": { "radiance": 1, "two_sided": true } } ] })");
    double const F = square(1.5 / 3.5), passed = square(1 - F);
    check_radiance(*scene, "recursive:generations=1", 0);
    check_radiance(*scene, "recursive:generations=2", passed);
    check_radiance(*scene, "recursive:generations=3", passed);
    check_radiance(*scene, "recursive:generations=4", passed * (1 + F * F));
    check_radiance(*scene, "recursive:generations=4,splits=4", passed * (1 + F * F));
    check_radiance(*scene, "recursive:generations=12", passed * (1 - std::pow(F, 12)) / (1 - F * F));
}

// Two mirrors face each other, the one behind the camera emits: L = R (1 + R^2 + R^4 ...), R = ((n-1)^2 + k^2) /
// ((n+1)^2 + k^2).
TEST_CASE("recursive sees a lamp between two mirrors as often as generations allow", "[law]") {
    auto const scene = test::scene_from(R"({
      "camera": { "type": "orthographic", "eye": [0, 0, 0], "target": [0, 0, 1], "window": 0.001 }, "film": { "size": [4, 4] },
      "materials": { "mirror": { "type": "conductor", "ior": { "n": 0.5, "k": 2 } } },
      "shapes": [ { "type": "quad", "corners": [[-5,-5,1],[-5,5,1],[5,5,1],[5,-5,1]], "material": "mirror" },
                  { "type": "quad", "corners": [[-5,-5,-1],[-5,5,-1],[5,5,-1],[5,-5,-1]], "material": "mirror", "emission": { "radiance": 1, "two_sided": true } } ] })");
    double const R = (0.25 + 4) / (2.25 + 4);
    for (int generations : {0, 1, 2, 3, 5, 8}) {
        double expected = 0;
        for (int meeting = 1; meeting <= generations; meeting += 2) expected += std::pow(R, meeting);
        check_radiance(*scene, fmt::format("recursive:generations={}", generations), expected);
    }
}
