// SPDX-License-Identifier: Apache-2.0
// Light paths through bodies that absorb and lie in one another: `bidirectional` and `light-tracing` against
// `reference_path` and `path` by a z-test. Fails for a segment of either subpath, a light sample, a join or a view of
// the camera that is not absorbed, for a light path that sets out in vacuum, for the index 1 outside every body, and
// for joins that count where a surface that is none stands between (they do not: shadow rays end there).
#include "support/agreement.h"

using namespace iride;
using namespace iride::test;

namespace {

void check_agreement(std::string const& text, Trial const& t = {}) {
    auto const scene = scene_from(text);
    CHECK(make_plan(*scene).media);
    test::check_agreement(*scene, t, 25);
}

std::string const wine =
    R"({ "type": "dielectric", "ior": 1.4, "absorption_per_m": { "pairs": [[360,0.3],[550,2],[830,0.2]] } })";
std::string const ball_inside =
    R"({ "type": "sphere", "centre": [0.2,0.6,0], "radius": 0.35, "material": { "type": "diffuse", "reflectance": 0.8 } })";

}  // namespace

TEST_CASE("bidirectional agrees: a diffuse ball and a lamp within coloured glass", "[law]") {
    check_agreement(scene_text(
        view,
        R"("shapes": [)" + floor_quad + "," + lamp + "," + sphere(wine) + "," + ball_inside +
            R"(, { "type": "sphere", "centre": [-0.3,0.9,-0.1], "radius": 0.15, "material": { "type": "black" }, "emission": { "radiance": 5 } }])"));
}
// Camera, lamps and surfaces see each other through what fills the place, up to the walls of a closed room.
TEST_CASE("bidirectional and light tracing agree: all of the place absorbs", "[law]") {
    std::string const text = scene_text(
        view, R"("medium": { "absorption_per_m": { "pairs": [[360,0.05],[550,0.3],[830,0.1]] } }, "shapes": [)" +
                  floor_quad + "," + lamp + "," + big_lamp_sphere + "," +
                  sphere(R"({ "type": "diffuse", "reflectance": 0.8 })") +
                  R"(], "lights": [{ "type": "point", "position": [-1,2,-2], "intensity": 3 }])");
    check_agreement(text, {.oracle = "path", .oracle_spp = 4000});
    check_agreement(text, {.integrator = "light-tracing", .oracle = "path", .spp = 6000, .oracle_spp = 4000});
}
// Water overlaps the glass around it and a body of the same glass; within, a diffuse ball that is seen by way of both.
TEST_CASE("bidirectional agrees: water in glass", "[law]") {
    check_agreement(scene_text(
        view,
        R"("materials": { "glass": { "type": "dielectric", "ior": 1.5, "priority": 2, "absorption_per_m": 0.2 },
                          "water": { "type": "dielectric", "ior": 1.33, "priority": 1, "absorption_per_m": { "pairs": [[360,0.2],[600,1],[830,2]] } } },
           "shapes": [)" +
            floor_quad + "," + lamp + "," + ball_inside +
            R"(, { "type": "box", "min": [-0.8,0.01,-0.8], "max": [-0.6,1.4,0.8], "material": "glass" },
                { "type": "box", "min": [0.7,0.01,-0.8], "max": [0.9,1.4,0.8], "material": "glass" },
                { "type": "box", "min": [-0.7,0.05,-0.7], "max": [0.8,1.2,0.7], "material": "water" }])"));
}
// A body of index 1 hangs about everything but the camera: its surface is met, by light and camera paths, without a
// change of direction.
TEST_CASE("bidirectional agrees: a camera before a room of mist", "[law]") {
    check_agreement(scene_text(
        R"({ "eye": [0, 1, -4], "target": [0, 0.6, 0], "field_deg": 30 })",
        R"("materials": { "mist": { "type": "dielectric", "ior": 1, "absorption_per_m": 0.3 } }, "shapes": [)" +
            floor_quad + "," + lamp + "," + sphere(R"({ "type": "diffuse", "reflectance": 0.8 })") +
            R"(, { "type": "sphere", "centre": [0,0.7,0], "radius": 3, "material": "mist" }])"));
}
