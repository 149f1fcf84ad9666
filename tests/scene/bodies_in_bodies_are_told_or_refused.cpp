// SPDX-License-Identifier: Apache-2.0
// Where bodies lie is found before rendering, and what cannot be is refused with the place and what is allowed.
#include <catch2/catch.hpp>

#include "scene/bodies.h"
#include "support/scenes.h"

using namespace iride;
using Catch::Matchers::Contains;

namespace {

std::string scene_text(std::string const& materials, std::string const& shapes) {
    return R"({ "camera": { "eye": [0,0,-5], "target": [0,0,0], "field_deg": 40 },)"
           "\n\"materials\": {" +
           materials + "},\n\"shapes\": [" + shapes + "] }";
}
std::string refusal(std::string const& materials, std::string const& shapes = "") {
    try {
        test::scene_from(scene_text(materials, shapes));
    } catch (InputError const& e) {
        return e.what();
    }
    return "(accepted)";
}
std::string dielectric(std::string const& name, std::string const& keys) {
    return "\"" + name + R"(": { "type": "dielectric", )" + keys + " }";
}
std::string ball(std::string const& material, std::string const& z, std::string const& radius) {
    return R"({ "type": "sphere", "centre": [0,0,)" + z + R"(], "radius": )" + radius + R"(, "material": ")" +
           material + "\" }";
}

}  // namespace

TEST_CASE("bodies that overlap without priorities are refused", "[input]") {
    std::string const glass = dielectric("glass", R"("ior": 1.5)"), water = dielectric("water", R"("ior": 1.3)");
    std::string const nested = ball("glass", "0", "1") + "," + ball("water", "0.1", "0.5");
    CHECK_THAT(refusal(glass + ",\n" + water, nested),
               Contains("scene.json:2:") && Contains("materials.glass: near (") &&
                   Contains(" m it overlaps 'water', and not both have a 'priority'; allowed") &&
                   Contains("allowed: whole numbers that differ"));
    std::string const first = dielectric("glass", R"("ior": 1.5, "priority": 1)");
    CHECK_THAT(refusal(first + "," + water, nested), Contains("not both have a 'priority'"));
    CHECK_THAT(refusal(first + "," + dielectric("water", R"("ior": 1.3, "priority": 1)"), nested),
               Contains("m it has the priority 1 of 'water' too, which it overlaps"));
    CHECK(refusal(first + "," + dielectric("water", R"("ior": 1.3, "priority": 2)"), nested) == "(accepted)");
    CHECK(refusal(glass + "," + dielectric("water", R"("ior": 1.3, "exterior_ior": 1.5)"), nested) == "(accepted)");
    // Coming out of the water, light would go on through glass that does not absorb.
    CHECK_THAT(refusal(dielectric("glass", R"("ior": 1.5, "absorption_per_m": 1)") + "," +
                           dielectric("water", R"("ior": 1.3, "exterior_ior": 1.5)"),
                       nested),
               Contains("overlaps 'water'"));
    CHECK(refusal(glass + "," + water, ball("glass", "0", "1") + "," + ball("water", "2.1", "1")) == "(accepted)");
}
TEST_CASE("an overlap as thin as a hundredth of a body is found", "[input]") {
    std::string const both = dielectric("glass", R"("ior": 1.5)") + "," + dielectric("water", R"("ior": 1.3)");
    std::string const wall = R"({ "type": "box", "min": [-1,-1,0], "max": [1,1,1], "material": "glass" }, )";
    CHECK_THAT(
        refusal(both, wall + R"({ "type": "box", "min": [-1.1,-1.1,0.99], "max": [1.1,1.1,2], "material": "water" })"),
        Contains("overlaps"));
    CHECK(refusal(both,
                  wall + R"({ "type": "box", "min": [-1.1,-1.1,1.01], "max": [1.1,1.1,2], "material": "water" })") ==
          "(accepted)");
}
TEST_CASE("priorities are whole numbers and stand alone", "[input]") {
    CHECK_THAT(refusal(dielectric("a", R"("ior": 1.5, "priority": 1.5)")),
               Contains("materials.a.priority: found 1.5, but a whole number is wanted"));
    CHECK_THAT(refusal(dielectric("a", R"("ior": 1.5, "priority": "high")")), Contains("materials.a.priority: found"));
    CHECK_THAT(refusal(dielectric("a", R"("ior": 1.5, "priority": 1e9)")), Contains("allowed: in -1000000 .. 1000000"));
    CHECK_THAT(refusal(dielectric("a", R"("ior": 1.5, "priority": 1, "exterior_ior": 1.3)")),
               Contains("materials.a.exterior_ior: found together with 'priority'"));
}
TEST_CASE("what absorbs like a metal is no transparent body", "[input]") {
    CHECK_THAT(refusal(dielectric("a", R"("ior": "Au")")),
               Contains("scene.json:2:") && Contains("materials.a.ior: found k up to ") &&
                   Contains("allowed for a transparent body: 0 .. 0.001") && Contains("'conductor'"));
    CHECK_THAT(refusal(dielectric("a", R"("ior": 1.5, "exterior_ior": { "n": 1, "k": 0.01 })")),
               Contains("materials.a.exterior_ior: found k up to 0.01"));
    CHECK_THAT(refusal(dielectric("a", R"("ior": 1.5, "absorption_per_m": 1e6)")),
               Contains("materials.a.absorption_per_m: found 1e+06 1/m at 830 nm, as much as k = 0.066"));
    CHECK(refusal(dielectric("a", R"("ior": { "n": 1.5, "k": 0.001 })")) == "(accepted)");
    CHECK(refusal(dielectric("a", R"("ior": { "n": "N-BK7", "k": "N-BK7:k" })")) == "(accepted)");
    CHECK_THAT(refusal(dielectric("a", R"("ior": "N-BK7:k")")), Contains("'N-BK7:k' holds k alone"));
}
TEST_CASE("absorptions that are none are refused", "[input]") {
    auto const colour = [](std::string const& transmittance, std::string const& distance) {
        return refusal(dielectric("a", R"("ior": 1.5, "absorption": { "transmittance": )" + transmittance +
                                           R"(, "distance": )" + distance + " }"));
    };
    CHECK(colour("0.5", "1") == "(accepted)");
    CHECK(colour("1", "1") == "(accepted)");
    CHECK_THAT(colour("1.2", "1"), Contains("materials.a.absorption.transmittance: values 1.2 .. 1.2 over the render "
                                            "range, allowed: in 0 .. 1"));
    CHECK_THAT(colour("0", "1"), Contains("absorption.transmittance: found 0 in the render range, allowed: above 0"));
    CHECK_THAT(colour(R"({ "pairs": [[400, 0.5], [500, 0]] })", "1"), Contains("found 0 in the render range"));
    CHECK_THAT(colour("-0.1", "1"), Contains("values -0.1"));
    CHECK_THAT(colour("0.5", "0"), Contains("materials.a.absorption.distance: found 0, allowed: above 0"));
    CHECK_THAT(colour("0.5", "-2"), Contains("absorption.distance: found -2"));
    CHECK_THAT(colour("0.5", "1e-9"), Contains("materials.a.absorption: found 6.93147e+08 1/m"));
    CHECK_THAT(refusal(dielectric("a", R"("ior": 1.5, "absorption": { "transmitance": 1, "distance": 1 })")),
               Contains("did you mean 'transmittance'?"));
    CHECK_THAT(refusal(dielectric("a", R"("ior": 1.5, "absorption_per_m": -1)")),
               Contains("materials.a.absorption_per_m: values -1 .. -1 over the render range, allowed: at least 0"));
    CHECK_THAT(refusal(dielectric("a", R"("ior": 1.5, "absorption_per_m": { "rgb": [1,0,0], "space": "sRGB" })")),
               Contains("an absorption has no RGB"));
    CHECK_THAT(refusal(dielectric(
                   "a", R"("ior": 1.5, "absorption_per_m": 1, "absorption": { "transmittance": 1, "distance": 1 })")),
               Contains("found together with 'absorption'"));
}
TEST_CASE("panes are thicker than nothing", "[input]") {
    auto const pane = [](std::string const& keys) { return refusal(R"("a": { "type": "slab", )" + keys + " }"); };
    CHECK(pane(R"("ior": "BK7", "thickness": 0.004)") == "(accepted)");
    CHECK_THAT(pane(R"("ior": "BK7", "thickness": 0)"), Contains("materials.a.thickness: found 0, allowed: above 0"));
    CHECK_THAT(pane(R"("ior": "BK7", "thickness": -1)"), Contains("found -1, allowed: above 0"));
    CHECK_THAT(pane(R"("ior": "BK7")"), Contains("materials.a: the key 'thickness' is missing"));
    CHECK_THAT(pane(R"("ior": "Ag", "thickness": 1)"), Contains("'conductor'"));
}

TEST_CASE("the bodies around a point are found, through a hole too", "[unit]") {
    auto const scene = test::scene_from(scene_text(
        dielectric("glass", R"("ior": 1.5, "priority": 2)") + "," +
            dielectric("water", R"("ior": 1.3, "priority": 1)") + "," + dielectric("ice", R"("ior": 1.31)"),
        ball("glass", "0", "1") + "," + ball("water", "0.9", "0.5") + "," + ball("ice", "5", "1") +
            R"(, { "type": "cylinder", "from": [4,0,0], "to": [4,1,0], "radius": 0.5, "caps": false, "material": "water" })"));
    auto const n_at = [&](float x, float y, float z) {
        Surroundings const in = surroundings_at(*scene, {x, y, z});
        return in.medium().n.at(Wavelengths{})[0];
    };
    CHECK(n_at(0, 0, -2) == 1);
    CHECK(n_at(0, 0, 0) == 1.5f);
    CHECK(n_at(0, 0, .8f) == 1.5f);
    CHECK(n_at(0, 0, 1.2f) == 1.3f);
    CHECK(n_at(0, 0, 5) == 1.31f);
    CHECK(n_at(4, .5f, 0) == 1.3f);
}
