// SPDX-License-Identifier: Apache-2.0
// Every kind of bad scene is refused with a message that says where, what was found, and what is allowed; all at once.
#include <catch2/catch.hpp>

#include "support/scenes.h"

using namespace iride;
using Catch::Matchers::Contains;

namespace {

std::string refusal(std::string const& text, std::vector<std::pair<std::string, std::string>> const& files = {}) {
    test::TemporaryFolder const folder;
    for (auto const& [name, content] : files) folder.write(name, content);
    try {
        load_scene(folder.write("scene.json", text));
    } catch (InputError const& e) {
        return e.what();
    }
    return "(accepted)";
}

std::string with(std::string const& rest) {
    return R"({ "camera": { "eye": [0,0,-5], "target": [0,0,0], "field_deg": 40 },)"
           "\n" +
           rest + "}";
}
std::string shape(std::string const& keys) { return with(R"("shapes": [ { )" + keys + " } ]"); }
std::string const grey = R"("material": { "type": "diffuse", "reflectance": 0.5 })";

}  // namespace

TEST_CASE("an unknown key offers the nearest name, with line and column", "[input]") {
    CHECK_THAT(refusal(with(R"("shapes": [ { "type": "sphere", "center": [0,0,0], "radius": 1, )" + grey + " } ]")),
               Contains("scene.json:2:") && Contains("shapes[0].center: unknown key; did you mean 'centre'?"));
}
TEST_CASE("all diagnostics of a file come at once", "[input]") {
    std::string const text = refusal(with(
        R"("film": { "size": [0, 10], "exposure": -1 }, "shapes": [ { "type": "sphere", "centre": [0,0], "radius": 0, "material": "gold" } ])"));
    CHECK_THAT(text, Contains("film.size: found 0 x 10, allowed: whole numbers 1") &&
                         Contains("film.exposure: found -1, allowed: above 0") &&
                         Contains("shapes[0].centre: found an array of 2, but an array of 3 numbers is wanted") &&
                         Contains("shapes[0].radius: found 0, allowed: above 0") &&
                         Contains("unknown material 'gold'"));
}
TEST_CASE("unknown material names and types are refused", "[input]") {
    CHECK_THAT(
        refusal(
            R"({ "camera": { "eye": [0,0,-5], "target": [0,0,0], "field_deg": 40 }, "materials": { "gold": { "type": "conductor", "ior": "Au" } },
                 "shapes": [ { "type": "sphere", "centre": [0,0,0], "radius": 1, "material": "glod" } ] })"),
        Contains("shapes[0].material: unknown material 'glod'; did you mean 'gold'?"));
    CHECK_THAT(refusal(with(R"("materials": { "a": { "type": "difuse", "reflectance": 1 } })")),
               Contains("did you mean 'diffuse'?"));
}
TEST_CASE("missing files are named", "[input]") {
    CHECK_THAT(refusal(shape(R"("type": "mesh", "file": "no.ply", )" + grey)),
               Contains("shapes[0].file") && Contains("no.ply"));
    CHECK_THAT(refusal(with(R"("materials": { "a": { "type": "conductor", "ior": "Aurum" } })")),
               Contains("'Aurum' is neither a shipped"));
    CHECK_THROWS_WITH(load_scene("/nonexistent/scene.json"), Contains("no such file"));
    CHECK_THROWS_WITH(find_scene("metal"), Contains("did you mean 'metals'?"));
}
TEST_CASE("meshes with NaN vertices or bad indices are refused", "[input]") {
    CHECK_THAT(refusal(shape(R"("type": "mesh", "file": "a.obj", )" + grey),
                       {{"a.obj", "v 0 0 nan\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"}}),
               Contains("a.obj"));
    CHECK_THAT(refusal(shape(R"("type": "mesh", "file": "a.obj", )" + grey),
                       {{"a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 9\n"}}),
               Contains("a.obj"));
    CHECK_THAT(
        refusal(shape(R"("type": "mesh", "vertices": [[0,0,0],[1,0,0],[0,1,0]], "triangles": [[0,1,3]], )" + grey)),
        Contains("triangles[0]: found vertex 3, allowed: whole numbers 0 .. 2"));
}
TEST_CASE("vertex numbers of an inline mesh are whole", "[input]") {
    CHECK_THAT(
        refusal(shape(R"("type": "mesh", "vertices": [[0,0,0],[1,0,0],[0,1,0]], "triangles": [[0,1,1.5]], )" + grey)),
        Contains("shapes[0].triangles[0]: found vertex 1.5, allowed: whole numbers 0 .. 2"));
    CHECK_THAT(
        refusal(shape(R"("type": "mesh", "vertices": [[0,0,0],[1,0,0],[0,1,0]], "triangles": [[0,1,-0.5]], )" + grey)),
        Contains("found vertex -0.5"));
}
TEST_CASE("emitters without area are refused", "[input]") {
    CHECK_THAT(
        refusal(shape(
            R"("type": "mesh", "vertices": [[0,0,0],[1,0,0],[2,0,0]], "triangles": [[0,1,2]], "emission": { "radiance": 1 }, )" +
            grey)),
        Contains("shapes[0].emission: this emitter has no area"));
    CHECK_THAT(refusal(shape(R"("type": "quad", "corners": [[0,0,0],[1,0,0],[2,0,0],[3,0,0]], )" + grey)),
               Contains("the quad has no area"));
}
TEST_CASE("reflectances outside 0 .. 1 are refused", "[input]") {
    CHECK_THAT(refusal(with(R"("materials": { "a": { "type": "diffuse", "reflectance": 1.2 } })")),
               Contains("materials.a.reflectance: values 1.2 .. 1.2 over the render range, allowed: in 0 .. 1"));
    CHECK_THAT(
        refusal(with(
            R"("materials": { "a": { "type": "diffuse", "reflectance": { "pairs": [[400, 0.2], [500, -0.1]] } } })")),
        Contains("values -0.1 .. 0.2"));
    CHECK_THAT(
        refusal(with(
            R"("materials": { "a": { "type": "diffuse", "reflectance": { "rgb": [0, 1, 0], "space": "ACEScg" } } })")),
        Contains("materials.a.reflectance.rgb: no smooth reflectance has the colour (0, 1, 0) of linear ACEScg; the "
                 "nearest found is") &&
            Contains("CIE 1976 difference"));
}
TEST_CASE("an n, k table must cover the render range", "[input]") {
    CHECK_THAT(refusal(with(R"("materials": { "a": { "type": "dielectric", "ior": "SF11" } })")),
               Contains("'SF11' is given on 390..2500 nm, the render range is 360..830 nm") && Contains("outside"));
}
TEST_CASE("one short table of many places is one remark, the first place named", "[input]") {
    std::string const paint = R"("material": { "type": "diffuse", "reflectance": "paint.csv" })";
    std::string shapes;
    for (int i = 0; i < 3; ++i)
        shapes += (i ? ", " : "") + (R"({ "type": "sphere", "centre": [0,0,0], "radius": 1, )" + paint + "}");
    test::TemporaryFolder const folder;
    folder.write("paint.csv", "400,.1\n700,.2\n");
    auto const scene = load_scene(folder.write("scene.json", with("\"shapes\": [" + shapes + "]")));
    REQUIRE(scene->remarks.size() == 1);
    CHECK_THAT(scene->remarks[0], Contains("shapes[0].material.reflectance and 2 more: 'paint.csv' is given on") &&
                                      Contains("400..700 nm") && Contains("its end value is held"));
}
TEST_CASE("singular transforms are refused", "[input]") {
    CHECK_THAT(
        refusal(shape(R"("type": "sphere", "centre": [0,0,0], "radius": 1, "transform": [ { "scale": [1, 0, 1] } ], )" +
                      grey)),
        Contains("shapes[0].transform: the transform is singular"));
}
TEST_CASE("a truncated or damaged environment picture is refused", "[input]") {
    std::string const exr("\x76\x2f\x31\x01\x02\x00\x00\x00", 8);
    CHECK_THAT(refusal(with(R"("lights": [ { "type": "environment", "image": "sky.exr" } ])"), {{"sky.exr", exr}}),
               Contains("lights[0].image") && Contains("sky.exr"));
    CHECK_THAT(refusal(with(R"("lights": [ { "type": "environment", "image": "none.exr" } ])")),
               Contains("no such file"));
}
TEST_CASE("nesting, emptiness and size of the file itself are checked first", "[input]") {
    CHECK_THAT(refusal(std::string(100000, '[')), Contains("nested deeper than 64 levels"));
    CHECK_THAT(refusal(""), Contains("the file is empty"));
    CHECK_THAT(refusal("{ \"camera\": }"), Contains("scene.json:1:13: syntax error"));
    CHECK_THAT(refusal("{ \"a\": 1, \"a\": 2 }"), Contains("the key 'a' is there twice"));
    CHECK_THAT(refusal("[]"), Contains("found an array of 0, but an object is wanted"));
    test::TemporaryFolder const folder;
    std::filesystem::path const huge = folder.write("huge.json", "{");
    std::filesystem::resize_file(huge, 2ull << 30);  // sparse: takes no room
    CHECK_THROWS_WITH(load_scene(huge), Contains("has 2048 MiB, allowed: at most 256 MiB"));
}
TEST_CASE("every shipped scene loads without a complaint", "[input]") {
    for (ShippedScene const& s : shipped_scenes()) {
        INFO(s.name);
        CHECK_NOTHROW(load_scene(find_scene(s.name)));
        CHECK(!s.description.empty());
    }
    CHECK(shipped_scenes().size() >= 12);
}
TEST_CASE("coatings that are none are refused", "[input]") {
    auto const coated = [](std::string const& coating, std::string const& metal = R"("Ti")") {
        return refusal(with(R"("materials": { "a": { "type": "conductor", "ior": )" + metal + R"(, "coating": )" +
                            coating + "} }"));
    };
    auto const layer = [](std::string const& ior, std::string const& thickness) {
        return R"({ "ior": )" + ior + R"(, "thickness_nm": )" + thickness + "}";
    };
    CHECK(coated("[" + layer(R"("TiO2:Siefke")", "50") + "]") == "(accepted)");
    CHECK_THAT(coated("[" + layer("2.4", "-1") + "]"),
               Contains("materials.a.coating[0].thickness_nm: found -1, allowed: at least 0"));
    CHECK_THAT(coated("[" + layer("2.4", "1e999") + "]"), Contains("1e999") || Contains("thickness_nm: found inf"));
    CHECK_THAT(coated("[" + layer("2.4", R"("thick")") + "]"), Contains("coating[0].thickness_nm: found"));
    CHECK_THAT(coated(R"([ { "ior": 2.4 } ])"), Contains("coating[0]: the key 'thickness_nm' is missing"));
    CHECK_THAT(coated(R"([ { "ior": 2.4, "thicknes_nm": 5 } ])"), Contains("did you mean 'thickness_nm'?"));
    CHECK_THAT(coated("[" + layer("2.4", "5") + ", " + layer(R"({ "n": 2, "k": -0.1 })", "5") + "]"),
               Contains("materials.a.coating[1].ior.k: values -0.1 .. -0.1 over the render range, allowed: in 0"));
    CHECK_THAT(coated("[" + layer(R"("TiO2:Devore-o")", "50") + "]"),
               Contains("coating[0].ior: 'TiO2:Devore-o' is given on 430..1530 nm, the render range is 360..830 nm"));
    std::string const nothing = R"({ "n": 0 })";
    CHECK_THAT(coated("[" + layer(nothing, "5") + "]"), Contains("coating[0].ior: n reaches 0"));
    CHECK_THAT(coated("[" + layer("2", "5") + "]", nothing), Contains("materials.a.ior: n reaches 0"));
    CHECK_THAT(coated("[" + layer("0", "5") + "]"),
               Contains("coating[0].ior: values 0 .. 0 over the render range, allowed: in 0.001 .. 1000") &&
                   !Contains("reaches"));
    CHECK_THAT(coated("[]"),
               Contains("materials.a.coating: found an array of 0, but an array of 1 .. 32 layers is wanted"));
    CHECK_THAT(coated("7"), Contains("materials.a.coating: found") && Contains("1 .. 32 layers"));
    std::string many = layer("2", "5");
    for (int i = 1; i < 33; ++i) many += ", " + layer("2", "5");
    CHECK_THAT(coated("[" + many + "]"), Contains("found an array of 33, but an array of 1 .. 32 layers is wanted"));
    CHECK_THAT(
        coated("[" + layer("1.5", "1e6") + "]"),
        Contains("materials.a.coating: a film of optical thickness 1500 um is not coherent: allowed up to 100 um"));
}
