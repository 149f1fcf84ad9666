// SPDX-License-Identifier: Apache-2.0
// Ambient occlusion against form factors: 1 - F of what stands in the way.
#include <fmt/format.h>

#include <catch2/catch.hpp>

#include "support/agreement.h"
#include "support/scenes.h"

using namespace iride;

namespace {

// Looks from aside at the origin of a floor that has more on it.
std::unique_ptr<Scene> above_floor(std::string const& more) {
    return test::scene_from(fmt::format(
        R"({{ "camera": {{ "type": "orthographic", "eye": [0, 0.5, -0.5], "target": [0, 0, 0], "window": 0.0001 }},
             "film": {{ "size": [4, 4] }}, "lights": [ {{ "type": "environment", "radiance": 1 }} ],
             "shapes": [ {{ "type": "quad", "corners": [[-2000,0,-2000],[-2000,0,2000],[2000,0,2000],[2000,0,-2000]], "material": {{ "type": "diffuse", "reflectance": 0.5 }} }}, {} ] }})",
        more));
}

void check_seen(Scene const& scene, std::string const& options, double expected) {
    for (char const* sampling : {"uniform", "cosine"}) {
        auto const m = test::picture_mean(test::rendered(
            scene, fmt::format("ambient-occlusion:sampling={}{}", sampling, options), {.spp = 4096, .seed = 2}));
        INFO(sampling << options);
        constexpr double finite = 1e-3;  // the walls end
        CHECK(std::abs(m[1].mean - expected) < 4 * std::sqrt(m[1].variance) + finite);
        CHECK(std::sqrt(m[1].variance) < 0.01);
    }
}

}  // namespace

// Fails for the uniform sampling without its cosine, and for shares of the solid angle: 1/2 there too, but 1 - h/D
// below.
TEST_CASE("half of a corner is occluded at any distance from the wall", "[law]") {
    for (double distance : {0.01, 0.5})
        check_seen(
            *above_floor(fmt::format(
                R"({{ "type": "quad", "corners": [[-2000,0,{0}],[-2000,2000,{0}],[2000,2000,{0}],[2000,0,{0}]], "material": {{ "type": "black" }} }})",
                distance)),
            "", 0.5);
}

TEST_CASE("a sphere above a plane occludes (r/d)^2", "[law]") {
    check_seen(
        *above_floor(R"({ "type": "sphere", "centre": [0,3,0], "radius": 1.5, "material": { "type": "black" } })"), "",
        0.75);
}

// Of a ceiling at height h only what is within D counts: 1 - (1 - (h/D)^2).
TEST_CASE("what is farther than the distance does not occlude", "[law]") {
    auto const scene = above_floor(
        R"({ "type": "quad", "corners": [[-2000,2,-2000],[-2000,2,2000],[2000,2,2000],[2000,2,-2000]], "material": { "type": "black" } })");
    check_seen(*scene, ",distance=1.9", 1);
    check_seen(*scene, ",distance=2.5", 0.64);
    check_seen(*scene, ",distance=4", 0.25);
}
