// SPDX-License-Identifier: Apache-2.0
// Every strategy for direct light finds the same, and what `path` finds after one scattering; lamps add up.
#include <fmt/format.h>

#include <catch2/catch.hpp>

#include "support/agreement.h"
#include "support/scenes.h"

using namespace iride;

namespace {

std::string const floor_quad =
    R"({ "type": "quad", "corners": [[-3,0,-3],[-3,0,3],[3,0,3],[3,0,-3]], "material": { "type": "diffuse", "reflectance": 0.6 } })";

std::string scene_text(std::string const& rest) {
    return fmt::format(
        R"({{ "camera": {{ "eye": [0, 1, -4], "target": [0, 0.6, 0], "field_deg": 40 }}, "film": {{ "size": [12, 12] }},
             "render": {{ "sampler": "independent", "max_bounces": 1 }}, {} }})",
        rest);
}

// Rectangle, sphere and triangles of different strength, a sky; plastic, rough gold, rough glass.
std::string const three_lamps = scene_text(
    R"("lights": [{ "type": "environment", "radiance": 0.1 }], "shapes": [)" + floor_quad +
    R"(, { "type": "sphere", "centre": [0,0.7,0], "radius": 0.7, "material": { "type": "plastic", "reflectance": "cornell:red", "roughness": 0.4 } }
       , { "type": "sphere", "centre": [-1.2,0.4,-0.4], "radius": 0.4, "material": { "type": "conductor", "ior": "Au", "roughness": 0.4 } }
       , { "type": "sphere", "centre": [1,0.4,-0.9], "radius": 0.4, "material": { "type": "dielectric", "ior": 1.5, "roughness": 0.5 } }
       , { "type": "quad", "corners": [[-1.2,2.5,-1],[1,2.5,-1],[1,2.5,1.2],[-1.2,2.5,1.2]], "material": { "type": "black" }, "emission": { "radiance": 3 } }
       , { "type": "sphere", "centre": [1.8,1.6,0.5], "radius": 0.5, "material": { "type": "diffuse", "reflectance": 0.3 }, "emission": { "radiance": 5 } }
       , { "type": "mesh", "vertices": [[-2,1,-1],[-2,2.2,-1],[-2,1.8,1],[-2.2,1.4,1]], "triangles": [[0,1,2],[0,2,3]], "material": { "type": "black" }, "emission": { "radiance": 2, "two_sided": true } }])");

}  // namespace

// Fails for lamps averaged, the choice among them left out of a density or of a weight, a density over area taken for
// one over solid angle, and directions of one side alone where light comes through.
TEST_CASE("every strategy for direct light finds what path finds after one scattering", "[law]") {
    auto const scene = test::scene_from(three_lamps);
    RenderSettings settings{.spp = 2048, .seed = 21, .sampler = SamplerKind::independent};
    Film const path = test::rendered(*scene, "path", settings);
    settings.spp = 1024;
    for (char const* how : {"hemisphere", "cosine", "bsdf", "area", "solid-angle", "mis", "mis,lights=uniform",
                            "mis,lights=tree", "mis,lights=all", "area,lights=all", "solid-angle,samples=4"}) {
        INFO(how);
        ++settings.seed;
        test::check_films_agree(test::rendered(*scene, fmt::format("direct:strategy={}", how), settings), path);
    }
}

TEST_CASE("direct light of point and spot lamps behind a mirror is what path finds after one scattering", "[law]") {
    auto const scene = test::scene_from(scene_text(
        R"("lights": [ { "type": "spot", "position": [1,3,-1], "target": [0,0,0], "cone_deg": 40, "full_deg": 10, "intensity": 9 },
             { "type": "point", "position": [-1,2,-2], "intensity": 3 }, { "type": "environment", "radiance": 0.2 } ], "shapes": [)" +
        floor_quad +
        R"(, { "type": "sphere", "centre": [0,0.7,0], "radius": 0.7, "material": { "type": "conductor", "ior": "Ag" } }])"));
    RenderSettings settings{.spp = 1024, .seed = 31, .sampler = SamplerKind::independent};
    Film const path = test::rendered(*scene, "path", settings);
    for (char const* how : {"mis", "solid-angle,lights=all", "mis,lights=tree"}) {
        INFO(how);
        ++settings.seed;
        test::check_films_agree(test::rendered(*scene, fmt::format("direct:strategy={}", how), settings), path);
    }
}

// A sphere of radiance L wholly above the horizon gives the irradiance pi L (r/d)^2 cos. Fails where the lamps' mean is
// taken: a third.
TEST_CASE("three lamps of different power add up", "[law]") {
    struct Lamp {
        VectorDouble at;
        double radius, radiance;
    };
    std::vector<Lamp> const lamps{{{0, 3, 0}, 0.5, 1}, {{2, 2, 0}, 0.3, 20}, {{-1, 4, 3}, 0.8, 6}};
    constexpr double rho = 0.6;
    std::string shapes = floor_quad;
    double expected = 0;
    for (Lamp const& l : lamps) {
        shapes += fmt::format(
            R"(, {{ "type": "sphere", "centre": [{},{},{}], "radius": {}, "material": {{ "type": "black" }}, "emission": {{ "radiance": {} }} }})",
            l.at[0], l.at[1], l.at[2], l.radius, l.radiance);
        expected += rho * l.radiance * square(l.radius / l.at.norm()) * l.at[1] / l.at.norm();
    }
    auto const scene = test::scene_from(fmt::format(
        R"({{ "camera": {{ "type": "orthographic", "eye": [0, 1, 0], "target": [0, 0, 0], "up": [0, 0, 1], "window": 0.001 }},
             "film": {{ "size": [4, 4] }}, "render": {{ "max_bounces": 1 }}, "shapes": [{}] }})",
        shapes));
    for (char const* how : {"path", "direct:lights=uniform", "direct:lights=power", "direct:lights=tree",
                            "direct:lights=all", "direct:strategy=solid-angle,lights=tree", "recursive"}) {
        INFO(how);
        auto const m = test::picture_mean(test::rendered(*scene, how, {.spp = 4096, .seed = 5}));
        CHECK(std::abs(m[1].mean - expected) < 4 * std::sqrt(m[1].variance) + 1e-4 * expected);
        CHECK(std::sqrt(m[1].variance) < 0.01 * expected);
    }
}

TEST_CASE("strategies that cannot find a scene's lights and unknown options are refused", "[input]") {
    auto const scene = test::scene_from(scene_text(
        R"("lights": [{ "type": "point", "position": [0,2,0], "intensity": 3 }], "shapes": [)" + floor_quad + "]"));
    RenderPlan const plan = make_plan(*scene);
    CHECK_THROWS_WITH(make_integrator("direct:strategy=cosine", *scene, plan),
                      Catch::Contains("point, spot or distant"));
    CHECK_THROWS_WITH(make_integrator("direct:strateg=mis", *scene, plan), Catch::Contains("did you mean 'strategy'"));
    CHECK_THROWS_WITH(make_integrator("direct:strategy=coseno", *scene, plan),
                      Catch::Contains("did you mean 'cosine'"));
    CHECK_THROWS_WITH(make_integrator("direct:samples=0", *scene, plan), Catch::Contains("allowed: in 1 .. 65536"));
    CHECK_THROWS_WITH(make_integrator("path:x=1", *scene, plan), Catch::Contains("unknown key"));
    CHECK_THROWS_WITH(make_integrator("direct:", *scene, plan), Catch::Contains("NAME:key=value"));
    CHECK_THROWS_WITH(make_integrator("direct:samples=1,samples=2", *scene, plan), Catch::Contains("stands twice"));
    CHECK_THROWS_WITH(make_integrator("drect", *scene, plan), Catch::Contains("did you mean 'direct'"));
}

TEST_CASE("a scene file asks an integrator by an object, errors have their place", "[input]") {
    auto const text = [](std::string const& integrator) {
        return "{ \"camera\": { \"eye\": [0,0,-9], \"target\": [0,0,0], \"field_deg\": 30 }, \"shapes\": [" +
               floor_quad + "],\n\"render\": {\n\"integrator\": " + integrator + " } }";
    };
    auto const good = test::scene_from(text(R"({ "name": "direct", "strategy": "area", "samples": 2 })"));
    CHECK(good->render.integrator.text() == "direct:strategy=area,samples=2");
    CHECK_NOTHROW(make_integrator(good->render.integrator, *good, make_plan(*good)));
    auto const bad = test::scene_from(text(R"({ "name": "direct", "samples": 2.5 })"));
    CHECK_THROWS_WITH(make_integrator(bad->render.integrator, *bad, make_plan(*bad)),
                      Catch::Contains("scene.json:3:") && Catch::Contains("render.integrator.samples"));
    CHECK_THROWS_WITH(test::scene_from(text(R"({ "strategy": "area" })")), Catch::Contains("'name' is missing"));
}
