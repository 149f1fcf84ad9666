// SPDX-License-Identifier: Apache-2.0
// Materials and emission profiles that cannot be are refused, with what was found and what is allowed.
#include <fmt/format.h>

#include <catch2/catch.hpp>

#include "support/scenes.h"

using namespace iride;
using Catch::Matchers::Contains;

namespace {

std::string scene_text(std::string const& rest) {
    return R"({ "camera": { "eye": [0,0,-5], "target": [0,0,0], "field_deg": 40 }, )" + rest + "}";
}
std::string refusal(std::string const& rest) {
    try {
        test::scene_from(scene_text(rest));
    } catch (InputError const& e) {
        return e.what();
    }
    return "(accepted)";
}
std::string material(std::string const& keys) { return refusal("\"materials\": { \"a\": {" + keys + "} }"); }
std::string emission(std::string const& keys) {
    return refusal(
        R"("shapes": [ { "type": "sphere", "centre": [0,0,0], "radius": 1, "material": { "type": "black" }, "emission": { )" +
        keys + " } } ]");
}
std::string spot(std::string const& keys) {
    return refusal(R"("lights": [ { "type": "spot", "position": [0,0,0], "target": [0,0,1], "intensity": 1, )" + keys +
                   " } ]");
}

std::string const grey = R"({ "type": "diffuse", "reflectance": 0.5 })";

}  // namespace

TEST_CASE("mixtures whose weights do not sum to 1 are refused", "[input]") {
    auto const mixture = [](double a, double b) {
        return material(fmt::format(
            R"("type": "mixture", "parts": [ {{ "material": {}, "weight": {} }}, {{ "material": {}, "weight": {} }} ])",
            grey, a, grey, b));
    };
    CHECK(mixture(.3, .7) == "(accepted)");
    CHECK(mixture(.3333333, .6666666) == "(accepted)");
    CHECK_THAT(mixture(.3, .6), Contains("materials.a.parts: the weights sum to 0.9") && Contains("must sum to 1"));
    CHECK_THAT(mixture(-.3, 1.3), Contains("materials.a.parts[0].weight: found -0.3, allowed: in 0 .. 1"));
    CHECK_THAT(material(R"("type": "mixture", "parts": [])"),
               Contains("materials.a.parts: found") && Contains("1 .. 64"));
    CHECK_THAT(material(R"("type": "mixture")"), Contains("parts"));
}

TEST_CASE("a material made of itself or of unknown or transparent ones is refused", "[input]") {
    CHECK_THAT(material(R"("type": "mixture", "parts": [ { "material": "a", "weight": 1 } ])"),
               Contains("materials.a.parts[0].material: material 'a' is made of itself"));
    CHECK_THAT(refusal(R"("materials": { "a": { "type": "two-sided", "front": "b", "back": "grey" },
                          "b": { "type": "mixture", "parts": [ { "material": "a", "weight": 1 } ] }, "grey": )" +
                       grey + "}"),
               Contains("material 'a' is made of itself"));
    CHECK_THAT(refusal(R"("materials": { "a": { "type": "two-sided", "front": "gray", "back": "grey" }, "grey": )" +
                       grey + "}"),
               Contains("materials.a.front: unknown material 'gray'; did you mean 'grey'?"));
    CHECK_THAT(material(R"("type": "two-sided", "front": { "type": "dielectric", "ior": 1.5 }, "back": )" + grey),
               Contains("materials.a.front: a transparent body has an inside"));
    CHECK_THAT(material(R"("type": "two-sided", "front": )" + grey), Contains("back"));
    std::string deep = grey;
    for (int i = 0; i < 40; ++i) deep = R"({ "type": "two-sided", "front": )" + grey + R"(, "back": )" + deep + "}";
    CHECK_THAT(refusal("\"materials\": { \"a\": " + deep + "}"), Contains("more than 32 deep"));
}

TEST_CASE("coats and rough diffuse surfaces out of range are refused", "[input]") {
    CHECK_THAT(material(R"("type": "oren-nayar", "reflectance": 0.5, "roughness": 1.5)"),
               Contains("materials.a.roughness: found 1.5, allowed: in 0 .. 1"));
    CHECK_THAT(material(R"("type": "plastic", "reflectance": 0.5, "ior": 0.9)"),
               Contains("materials.a.ior: allowed: an index of at least 1"));
    CHECK_THAT(material(R"("type": "plastic", "reflectance": 0.5, "ior": "Au")"), Contains("the coat absorbs (k > 0)"));
    CHECK_THAT(material(R"("type": "plastic", "reflectance": 0.5, "roughness": 1e-4)"),
               Contains("materials.a.roughness: allowed: 0 (a smooth coat) or 0.001 .. 1"));
    CHECK_THAT(material(R"("type": "plastic", "reflectance": 0.5, "coat_transmittance": 0)"),
               Contains("materials.a.coat_transmittance: values 0 .. 0"));
    CHECK(
        material(
            R"("type": "plastic", "reflectance": 0.5, "ior": "N-BK7", "roughness": 0.2, "coat_transmittance": 0.8)") ==
        "(accepted)");
}

TEST_CASE("heuristic models out of range are refused, and what they break is remarked", "[input]") {
    CHECK_THAT(material(R"("type": "phong", "specular": 0.5, "exponent": -1)"),
               Contains("materials.a.exponent: found -1, allowed: in 0 .. 100000"));
    CHECK_THAT(material(R"("type": "phong", "specular": 0.7, "diffuse": 0.4, "exponent": 5)"),
               Contains("'diffuse' and 'specular' sum to 1.1, allowed: at most 1"));
    CHECK_THAT(material(R"("type": "phong", "form": "rough", "specular": 0.5, "exponent": 1)"),
               Contains("materials.a.form: found 'rough'; allowed: raw, normalised"));
    auto const remarks = [](std::string const& keys) {
        auto const scene = test::scene_from(scene_text("\"materials\": { \"a\": {" + keys + "} }"));
        std::string all;
        for (std::string const& r : scene->remarks) all += r + "\n";
        return all;
    };
    // 8 pi (2^-5 + 10) / (12 * 14) = 1.50067, and pi 0.1.
    CHECK_THAT(
        remarks(R"("type": "modified-blinn-phong", "form": "raw", "diffuse": 0.1, "specular": 1, "exponent": 10)"),
        Contains("materials.a: this model gives back 1.815 times the light along the normal"));
    CHECK_THAT(remarks(R"("type": "phong", "specular": 0.1, "exponent": 10)"),
               Contains("materials.a: this model is not reciprocal"));
    CHECK(remarks(R"("type": "modified-blinn-phong", "specular": 0.5, "diffuse": 0.5, "exponent": 10)").empty());
}

TEST_CASE("emission profiles and flaps out of range are refused", "[input]") {
    CHECK_THAT(emission(R"("radiance": 1, "profile": { "exponent": -1 })"),
               Contains("shapes[0].emission.profile.exponent: found -1"));
    CHECK_THAT(emission(R"("radiance": 1, "profile": { "cone_deg": 0 })"), Contains("cone_deg: found 0"));
    CHECK_THAT(emission(R"("radiance": 1, "profile": { "cone_deg": 120 })"), Contains("cone_deg: found 120"));
    CHECK_THAT(emission(R"("radiance": 1, "profile": { "cone": 20 })"),
               Contains("profile.cone: unknown key; allowed: exponent, cone_deg"));
    CHECK_THAT(spot(R"("cone_deg": 40, "full_deg": 50)"), Contains("'full_deg' must not be above 'cone_deg'"));
    CHECK_THAT(spot(R"("cone_deg": 40, "flaps": { "x_deg": [10, 10] })"), Contains("lights[0].flaps.x_deg: allowed"));
    CHECK_THAT(spot(R"("cone_deg": 40, "flaps": { "x_deg": [-95, 10] })"), Contains("lights[0].flaps.x_deg: allowed"));
    CHECK_THAT(spot(R"("cone_deg": 40, "up": [0,0,1], "flaps": {})"), Contains("not parallel to the beam"));
    CHECK_THAT(spot(R"("cone_deg": 40, "exponent": -2)"), Contains("lights[0].exponent: found -2"));
}
