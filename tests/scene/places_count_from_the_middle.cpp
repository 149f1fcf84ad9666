// SPDX-License-Identifier: Apache-2.0
// A scene that lies far from its file's origin is counted from its middle, so its picture is the same wherever it lies.
#include <fmt/format.h>

#include <catch2/catch.hpp>

#include "support/same_bits.h"

using namespace iride;

namespace {

std::string place(VectorDouble const& origin, double x, double y, double z) {
    VectorDouble const p = origin + VectorDouble(x, y, z);
    return fmt::format("[{:.17g}, {:.17g}, {:.17g}]", p.x(), p.y(), p.z());
}

// Every kind of shape and light with a place, in a room whose middle is `at`.
std::string room_at(VectorDouble const& at) {
    auto const p = [&](double x, double y, double z) { return place(at, x, y, z); };
    return fmt::format(
        R"({{ "camera": {{ "eye": {}, "target": {}, "field_deg": 90 }}, "film": {{ "size": [16, 16] }},
  "materials": {{ "grey": {{ "type": "diffuse", "reflectance": 0.5 }} }},
  "objects": {{ "ball": [ {{ "type": "sphere", "centre": [0, 0.25, 0], "radius": 0.5, "material": "grey" }} ] }},
  "instances": [ {{ "object": "ball", "transform": [ {{ "scale": [1, 2, 1] }}, {{ "translate": {} }} ] }} ],
  "shapes": [
    {{ "type": "box", "min": {}, "max": {}, "flip": true, "material": "grey" }},
    {{ "type": "sphere", "centre": {}, "radius": 0.5, "material": "grey" }},
    {{ "type": "disc", "centre": {}, "normal": [0, 0, -1], "radius": 0.5, "material": "grey" }},
    {{ "type": "cylinder", "from": {}, "to": {}, "radius": 0.25, "material": "grey" }},
    {{ "type": "mesh", "vertices": [{}, {}, {}], "triangles": [[0, 1, 2], [0, 2, 1]], "material": "grey" }},
    {{ "type": "mesh", "file": "tile.obj", "material": "grey" }},
    {{ "type": "quad", "corners": [[0, 0, 0], [1, 0, 0], [1, 0, 1], [0, 0, 1]], "material": "grey",
       "transform": [ {{ "rotate": [0, 0, 1], "angle_deg": 90 }}, {{ "translate": {} }} ] }},
    {{ "type": "quad", "corners": [{}, {}, {}, {}], "material": "grey", "emission": {{ "radiance": 3 }} }} ],
  "lights": [ {{ "type": "point", "position": {}, "intensity": 5 }},
              {{ "type": "spot", "position": {}, "target": {}, "cone_deg": 60, "intensity": 20 }} ] }})",
        p(0, 0, -3.5), p(0, 0, 4), p(1, -3, 1), p(-4, -4, -4), p(4, 4, 4), p(-2, 0, 2), p(2, 1, 3), p(-3, -4, 3),
        p(-3, 2, 3), p(0, 1, 3), p(1, 1, 3), p(0, 2, 3), p(3, 0, 1), p(-1, 3.5, -1), p(1, 3.5, -1), p(1, 3.5, 1),
        p(-1, 3.5, 1), p(2, 2, -2), p(-2, 3, -1), p(0, -4, 0));
}

std::unique_ptr<Scene> load_room_at(VectorDouble const& at) {
    TemporaryFolder const folder;
    std::string tile;
    for (VectorDouble const& v : {VectorDouble(-1, 0, 2), VectorDouble(-1, 1, 2), VectorDouble(-2, 0, 3)})
        tile += fmt::format("v {:.17g} {:.17g} {:.17g}\n", at.x() + v.x(), at.y() + v.y(), at.z() + v.z());
    folder.write("tile.obj", tile + "f 1 2 3\nf 1 3 2\n");
    return load_scene(folder.write("room.json", room_at(at)));
}

}  // namespace

// Fails, picture by picture, for any place that is not counted from the middle.
TEST_CASE("a scene makes the same picture wherever it lies", "[law]") {
    auto const here = load_room_at({0, 0, 0});
    REQUIRE(here->origin.isZero());
    for (VectorDouble const& at :
         {VectorDouble(0, 64, 0), VectorDouble(65536, -65536, 32768), VectorDouble(0x1p33, 0x1p40, -0x1p20)}) {
        auto const there = load_room_at(at);
        CHECK(there->origin == at);
        CHECK(there->remarks == here->remarks);
        for (char const* integrator : {"path", "bidirectional", "reference_path"})
            CHECK(test::picture_values(*there, integrator, 2, false) ==
                  test::picture_values(*here, integrator, 2, false));
    }
}

TEST_CASE("places are reported as the file counts them", "[unit]") {
    VectorDouble const at(65536, -65536, 32768);
    auto const scene = load_room_at(at);
    RenderPlan const plan = make_plan(*scene);
    auto const decision = std::ranges::find(plan.decisions, "origin", &RenderPlan::Decision::name);
    REQUIRE(decision != plan.decisions.end());
    CHECK(decision->used);
    CHECK(decision->reason.find("(65536, -65536, 32768) m") != std::string::npos);
}

TEST_CASE("a scene as large as its way from the origin stays where it is", "[unit]") {
    CHECK(load_room_at({16, 0, 0})->origin.isZero());
}
