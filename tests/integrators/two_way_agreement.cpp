// SPDX-License-Identifier: Apache-2.0
// `bidirectional` and `light-tracing` against `path` and `reference_path` by a z-test on small scenes, and against
// closed forms.
#include "support/agreement.h"
#include "support/same_bits.h"

using namespace iride;
using namespace iride::test;

namespace {

void check_agreement(std::string const& text, Trial const& t = {}) { test::check_agreement(*scene_from(text), t); }

std::string const dispersive_glass = R"({ "type": "dielectric", "ior": { "pairs": [[300, 2.0], [900, 1.4]] } })";
std::string const back_wall =
    R"({ "type": "quad", "corners": [[-3,0,2],[-3,4,2],[3,4,2],[3,0,2]], "material": { "type": "diffuse", "reflectance": "cornell:red" } })";

std::unique_ptr<Scene> with_faceted_ball(std::string const& material) {
    TemporaryFolder const folder;
    folder.write("ball.obj", faceted_ball);
    return load_scene(folder.write(
        "scene.json",
        scene_text(view, R"("shapes": [)" + floor_quad + "," + back_wall + "," + big_lamp_sphere +
                             R"(, { "type": "mesh", "file": "ball.obj", "material": )" + material + "}]")));
}

}  // namespace

TEST_CASE("bidirectional agrees: diffuse and rough gold under a rectangle, with either heuristic", "[law]") {
    std::string const text =
        scene_text(view, R"("shapes": [)" + floor_quad + "," + lamp + "," + back_wall + "," +
                             sphere(R"({ "type": "conductor", "ior": "Au", "roughness": 0.3 })") + "]");
    check_agreement(text, {.oracle = "path", .oracle_spp = 3000});
    check_agreement(text, {.integrator = "bidirectional-power", .oracle = "path", .oracle_spp = 3000});
}
TEST_CASE("light tracing agrees: diffuse and rough gold under a rectangle, the lamp in view", "[law]") {
    check_agreement(scene_text(R"({ "eye": [0, 1.2, -6], "target": [0, 1.2, 0], "field_deg": 40 })",
                               R"("shapes": [)" + floor_quad + "," + lamp + "," + back_wall + "," + big_lamp_sphere +
                                   "," + sphere(R"({ "type": "conductor", "ior": "Au", "roughness": 0.3 })") + "]"),
                    {.integrator = "light-tracing", .oracle = "path", .spp = 4000, .oracle_spp = 3000});
}
TEST_CASE("bidirectional agrees: dispersive glass under a rectangle and sky", "[law]") {
    std::string const text = scene_text(view, R"("lights": [{ "type": "environment", "radiance": 0.3 }], "shapes": [)" +
                                                  floor_quad + "," + lamp + "," + sphere(dispersive_glass) + "]");
    check_agreement(text);
    check_agreement(text, {.integrator = "bidirectional-power"});
}
TEST_CASE("bidirectional agrees: rough dispersive glass", "[law]") {
    check_agreement(scene_text(
        view,
        R"("shapes": [)" + floor_quad + "," + lamp + "," + back_wall + "," +
            sphere(R"({ "type": "dielectric", "ior": { "pairs": [[300, 2.0], [900, 1.4]] }, "roughness": 0.3 })") +
            "]"));
}
// A diffuse ball within glass: vertices joined inside have crossed the boundary once from either end.
TEST_CASE("bidirectional agrees: a diffuse ball and a lamp within glass", "[law]") {
    check_agreement(scene_text(
        view,
        R"("shapes": [)" + floor_quad + "," + lamp + "," + sphere(R"({ "type": "dielectric", "ior": 1.8 })") +
            R"(, { "type": "sphere", "centre": [0.2,0.6,0], "radius": 0.35, "material": { "type": "diffuse", "reflectance": 0.8 } })"
            R"(, { "type": "sphere", "centre": [-0.3,0.9,-0.1], "radius": 0.15, "material": { "type": "black" }, "emission": { "radiance": 5 } }])"));
}
// Three lamps and lights without extent, of powers from 1 to 30.
TEST_CASE("bidirectional and light tracing agree: lights of every kind and different power", "[law]") {
    std::string const text = scene_text(
        view,
        R"("shapes": [)" + floor_quad + "," + back_wall + "," + big_lamp_sphere + "," +
            sphere(
                R"({ "type": "mixture", "parts": [ { "material": { "type": "diffuse", "reflectance": 0.8 }, "weight": 0.6 }, { "material": { "type": "conductor", "ior": "Au", "roughness": 0.4 }, "weight": 0.4 } ] })") +
            R"(, { "type": "mesh", "vertices": [[-1,2,-1],[1,2.2,-1],[1,1.8,1],[-1.2,2.4,1]], "triangles": [[0,1,2],[0,2,3]], "material": { "type": "black" }, "emission": { "radiance": 1, "two_sided": true, "profile": { "exponent": 3, "cone_deg": 60 } } }],
        "lights": [ { "type": "spot", "position": [1,3,-1], "target": [0,0,0], "cone_deg": 40, "full_deg": 10, "intensity": 9 },
                    { "type": "point", "position": [-1,2,-2], "intensity": 3 }, { "type": "distant", "direction": [0.2,-1,0.3], "irradiance": 0.5 } ])");
    check_agreement(text, {.oracle = "path", .spp = 2500, .oracle_spp = 4000});
    check_agreement(text, {.integrator = "light-tracing", .oracle = "path", .spp = 6000, .oracle_spp = 4000});
}
// A plastic has a Dirac and a density lobe side by side.
TEST_CASE("bidirectional agrees: plastic, silver and a lamp behind glass", "[law]") {
    check_agreement(scene_text(
        view,
        R"("shapes": [)" + floor_quad + "," + back_wall + "," +
            sphere(R"({ "type": "plastic", "reflectance": "cornell:red" })") +
            R"(, { "type": "sphere", "centre": [-1.3,0.5,0.3], "radius": 0.5, "material": { "type": "conductor", "ior": "Ag" } })"
            R"(, { "type": "box", "min": [0.4,1.6,-0.6], "max": [1.6,1.7,0.6], "material": { "type": "dielectric", "ior": 1.5 } })"
            R"(, { "type": "disc", "centre": [1,2.2,0], "normal": [0,-1,0], "radius": 0.6, "material": { "type": "black" }, "emission": { "radiance": 6 } }])"));
}
TEST_CASE("bidirectional and light tracing agree: shading normals", "[law]") {
    auto const scene = with_faceted_ball(R"({ "type": "diffuse", "reflectance": 0.8 })");
    check_agreement(*scene, {.oracle = "path", .oracle_spp = 3000});
    check_agreement(*scene, {.integrator = "light-tracing", .oracle = "path", .spp = 4000, .oracle_spp = 3000});
}
TEST_CASE("bidirectional and light tracing agree: thin lens, window, and every filter", "[law]") {
    std::string const rest = R"("shapes": [)" + floor_quad + "," + lamp + "," + back_wall + "," +
                             sphere(R"({ "type": "diffuse", "reflectance": 0.5 })") + "]";
    std::string const lens =
        R"({ "eye": [0, 1, -4], "target": [0, 0.6, 0], "field_deg": 40, "aperture_radius": 0.3, "focus_distance": 3 })";
    std::string const window = R"({ "type": "orthographic", "eye": [0, 1, -4], "target": [0, 0.6, 0], "window": 1.2 })";
    for (char const* integrator : {"bidirectional", "light-tracing"}) {
        Trial const trial{.integrator = integrator, .oracle = "path", .spp = 2500, .oracle_spp = 2500};
        check_agreement(scene_text(lens, rest, R"(, "filter": "gaussian")"), trial);
        check_agreement(scene_text(window, rest, R"(, "filter": "triangle")"), trial);
    }
}
TEST_CASE("bidirectional agrees on the shipped glass spheres", "[law]") {
    for (char const* name : {"glass-spheres"}) {
        auto const scene = load_scene(find_scene(name));
        scene->film.width = scene->film.height = 12;
        INFO(name);
        check_agreement(*scene, {.spp = 3000, .oracle_spp = 30000});
    }
}

// L = Le / (1 - rho) = 2; with n scatterings at most Le (1 - rho^(n+1)) / (1 - rho), rho = .5.
TEST_CASE("bidirectional finds 2 in the uniform cube, and the partial sums of bounded paths", "[law]") {
    auto const scene = load_scene(find_scene("cube-uniform"));
    scene->film.width = scene->film.height = 8;
    for (std::optional<int> bounces : {std::optional<int>(), {0}, {1}, {2}, {4}}) {
        scene->render.max_bounces = bounces;
        double const expected = bounces ? 2 * (1 - std::pow(0.5, *bounces + 1)) : 2;
        for (char const* integrator : {"bidirectional", "light-tracing"}) {
            auto const m = picture_mean(rendered(*scene, integrator, {.spp = 512, .seed = 13}));
            INFO(integrator << ", " << (bounces ? *bounces : -1) << " bounces");
            constexpr double level = 4.5;  // normal quantile of 1e-3 / 144 for some 30 comparisons
            for (Moments const& c : m) {
                CHECK(std::abs(c.mean - expected) < level * std::sqrt(c.variance) + 1e-5);
                CHECK(c.variance < square(0.02));
            }
        }
    }
}

TEST_CASE("bidirectional pictures are the same bits for any threads, tile order and passes", "[law]") {
    for (char const* name : {"cornell-gold", "prism"}) {
        auto const scene = load_scene(find_scene(name));
        scene->film.width = 70;  // neither side is a multiple of the tile's
        scene->film.height = 50;
        scene->film.band_count = 7;
        auto const picture = [&](int threads, bool reversed, bool doubling_passes = false) {
            return test::picture_values(*scene, "bidirectional", threads, reversed, doubling_passes);
        };
        INFO(name);
        auto const one = picture(1, false);
        CHECK((picture(2, false) == one));
        CHECK((picture(5, true) == one));
        CHECK((picture(1, false, true) == one));
    }
}

TEST_CASE("scenes that light paths cannot do are refused before rendering, and what is left out is said", "[input]") {
    auto const refusal = [](Scene const& scene, char const* integrator) {
        try {
            make_integrator(integrator, scene, make_plan(scene));
        } catch (InputError const& e) {
            return std::string(e.what());
        }
        return std::string();
    };
    auto const mirrors = scene_from(
        scene_text(view, R"("shapes": [)" + lamp + "," + sphere(R"({ "type": "conductor", "ior": "Ag" })") + "]"));
    CHECK(refusal(*mirrors, "light-tracing").find("mirror") != std::string::npos);
    CHECK(refusal(*mirrors, "bidirectional").empty());
    auto const scattering = load_scene(find_scene("haze"));
    CHECK(refusal(*scattering, "light-tracing").find("scatters") != std::string::npos);
    CHECK(refusal(*scattering, "bidirectional").find("'path'") != std::string::npos);
    auto const dark = scene_from(scene_text(view, R"("shapes": [)" + floor_quad + "]"));
    CHECK(refusal(*dark, "bidirectional").find("power") != std::string::npos);
    auto const some = scene_from(scene_text(view, R"("shapes": [)" + lamp + "," + floor_quad + "," +
                                                      sphere(R"({ "type": "conductor", "ior": "Ag" })") + "]"));
    auto const remarks = make_integrator("light-tracing", *some, make_plan(*some))->remarks();
    REQUIRE(remarks.size() == 1);
    CHECK(remarks[0].find("mirror images") != std::string::npos);
}
