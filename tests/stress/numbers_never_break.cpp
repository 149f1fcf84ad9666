// SPDX-License-Identifier: Apache-2.0
// The stress suite of bench/measure/stress.cpp in its short form, and in its long one.
#include <catch2/catch.hpp>

#include "bench/measure/stress.h"
#include "support/scenes.h"

namespace {

void check_all(int spp) {
    for (auto const& c : iride::bench::stress(spp)) {
        INFO(c.name << ": found " << c.value << ", allowed " << c.limit);
        CHECK(c.ok);
    }
}

}  // namespace

TEST_CASE("scales, distances, slivers, extreme materials and lamps break no picture", "[law]") { check_all(8); }
TEST_CASE("the same with many samples", "[.stress]") { check_all(1024); }

// Fails, in four pixels, for places that may lie in the plane of the wall at their triangle's edge.
TEST_CASE("a closed box lets nothing in at its edges", "[law]") {
    using namespace iride;
    auto const scene = test::scene_from(R"({ "camera": { "eye": [0,0,-0.48], "target": [0,0,0.5], "field_deg": 120 },
      "film": { "size": [24,24] },
      "shapes": [ { "type": "box", "min": [-0.5,-0.5,-0.5], "max": [0.5,0.5,0.5],
                    "material": { "type": "diffuse", "reflectance": 0.9 } } ],
      "lights": [ { "type": "environment", "radiance": 1 } ] })");
    Film const film = test::rendered(*scene, "path", {.spp = 8192, .seed = 2});
    int lit = 0;
    for (int i = 0; i < 24 * 24; ++i) lit += film.mean(i % 24, i / 24).Y > 0;
    CHECK(lit == 0);
}
