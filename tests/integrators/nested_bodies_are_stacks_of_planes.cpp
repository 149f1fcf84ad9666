// SPDX-License-Identifier: Apache-2.0
// Bodies that overlap and say by priority which of them fills the place, against what their surfaces are then: planes
// between known media, whose transmittance has a closed form; spheres in a furnace, where L / n^2 is one everywhere.
#include <catch2/catch.hpp>

#include "materials/fresnel.h"
#include "support/transparent_scenes.h"

using namespace iride;

namespace {

struct Layer {
    double n, k, d;  // d [m]
};

// Through plane layers in air, as paths without polarisation see them, every echo counted: layers are added one by one,
//   T <- T t T' / (1 - R' t^2 R''),   R <- R'' + T'^2 t^2 R / (1 - ...).
double stack_transmittance(std::vector<Layer> const& layers, double angle_deg, double nm) {
    double const S = std::sin(radians(angle_deg));
    auto const cosine = [&](double n) { return std::sqrt(1 - square(S / n)); };
    double n = 1, T = 1, R = 0, t = 1;  // of all surfaces so far; R from behind; t through what lies behind them
    for (std::size_t i = 0; i <= layers.size(); ++i) {
        Layer const next = i < layers.size() ? layers[i] : Layer{1, 0, 0};
        double const F = fresnel(cosine(n), next.n / n, 0.0).unpolarised();
        double const echo = 1 - R * square(t) * F;
        T *= t * (1 - F) / echo;
        R = F + square((1 - F) * t) * R / echo;
        n = next.n;
        t = std::exp(-4 * pi_double * next.k / (nm * 1e-9) * next.d / cosine(n));
    }
    return T;
}

std::string const glass_index = R"({ "n": 1.7, "k": 2e-8 })", water_index = R"({ "n": 1.3, "k": 5e-8 })";
std::string nested_materials() {
    return fmt::format(R"("glass": {{ "type": "dielectric", "ior": {}, "priority": 2 }},
                          "water": {{ "type": "dielectric", "ior": {}, "priority": 1 }})",
                       glass_index, water_index);
}
std::string plane(std::string const& material, double z, bool towards_viewer) {
    return fmt::format(
        R"({{ "type": "quad", "corners": [[-300,-300,{0}],[-300,300,{0}],[300,300,{0}],[300,-300,{0}]], "material": "{1}", "flip": {2} }})",
        z, material, !towards_viewer);
}

std::string interface(std::string const& name, std::string const& inside, std::string const& outside,
                      std::string const& roughness = "0") {
    return fmt::format(R"("{}": {{ "type": "dielectric", "ior": {}, "exterior_ior": {}, "roughness": {} }})", name,
                       inside, outside, roughness);
}

void check_transmittance(std::string const& text, double angle_deg, std::vector<Layer> const& layers) {
    auto const scene = test::scene_from(text);
    Xyz const wanted = test::colour_of([&](double nm) { return stack_transmittance(layers, angle_deg, nm); });
    for (char const* integrator : {"path", "reference_path"}) {
        Film const film =
            test::rendered(*scene, integrator, {.spp = 1 << 15, .seed = 31, .sampler = SamplerKind::independent});
        auto const [mean, error] = test::measured(film);
        INFO(integrator << " at " << angle_deg << ": " << mean.Y << " +- " << error.Y << ", wanted " << wanted.Y);
        CHECK(film.rejected() == std::array<std::uint64_t, rejection_count>{});
        constexpr double level = 4.5;
        CHECK(std::abs(mean.X - wanted.X) < level * error.X);
        CHECK(std::abs(mean.Y - wanted.Y) < level * error.Y);
        CHECK(std::abs(mean.Z - wanted.Z) < level * error.Z);
        CHECK(error.Y < 1e-3);
    }
}

std::vector<Layer> const water_between_glasses{{1.7, 2e-8, 1}, {1.3, 5e-8, 1}, {1.7, 2e-8, 1}};

}  // namespace

// Fails for index 1 outside every body.
TEST_CASE("water that overlaps the glasses around it is water between glasses", "[law]") {
    for (double angle : {0., 50.})
        check_transmittance(
            test::through_to_wall(angle, nested_materials(),
                                  test::wide_box("glass", 0, 1) + "," + test::wide_box("water", .8, 2.3) + "," +
                                      test::wide_box("glass", 2, 3)),
            angle, water_between_glasses);
}

TEST_CASE("interfaces that know both their sides make the same stack", "[law]") {
    std::string const materials =
        interface("glass", glass_index, "1") + "," + interface("water", water_index, glass_index);
    for (double angle : {0., 50.})
        check_transmittance(test::through_to_wall(angle, materials,
                                                  plane("glass", 0, true) + "," + plane("water", 1, true) + "," +
                                                      plane("water", 2, false) + "," + plane("glass", 3, false)),
                            angle, water_between_glasses);
}

// Fails for index 1 outside every body.
TEST_CASE("rough water that overlaps glass is a rough interface between both", "[law]") {
    std::string const nested = R"("glass": { "type": "dielectric", "ior": 1.7, "priority": 2 },
        "water": { "type": "dielectric", "ior": { "pairs": [[300, 1.36], [900, 1.3]] }, "priority": 1 },
        "frosted": { "type": "dielectric", "ior": { "pairs": [[300, 1.95], [900, 1.7]] }, "roughness": 0.8, "priority": 3 })";
    std::string const known = interface("glass", "1.7", "1") + "," +
                              interface("wet", R"({ "pairs": [[300, 1.95], [900, 1.7]] })",
                                        R"({ "pairs": [[300, 1.36], [900, 1.3]] })", "0.8") +
                              "," + interface("frosted", R"({ "pairs": [[300, 1.95], [900, 1.7]] })", "1", "0.8") +
                              "," + interface("water", R"({ "pairs": [[300, 1.36], [900, 1.3]] })", "1");
    auto const light_through = [](std::string const& materials, std::string const& shapes) {
        auto const scene = test::scene_from(test::through_to_wall(20, materials, shapes));
        return test::measured(test::rendered(*scene, "path", {.spp = 1 << 14, .seed = 3}));
    };
    auto const [one, error_of_one] =
        light_through(nested, test::wide_box("water", 0, 1.1) + "," + test::wide_box("frosted", 1, 2));
    auto const [two, error_of_two] =
        light_through(known, plane("water", 0, true) + "," + plane("wet", 1, true) + "," + plane("frosted", 2, false));
    INFO(one.Y << " and " << two.Y << " +- " << std::hypot(error_of_one.Y, error_of_two.Y));
    CHECK(std::abs(one.Y - two.Y) < 4.5 * std::hypot(error_of_one.Y, error_of_two.Y));
    CHECK(std::hypot(error_of_one.Y, error_of_two.Y) < 2.5e-3);
}

TEST_CASE("a body wholly inside one of higher priority is not there", "[law]") {
    check_transmittance(test::through_to_wall(35, nested_materials(),
                                              test::wide_box("glass", 0, 1) + "," + test::wide_box("water", .3, .7)),
                        35, {{1.7, 2e-8, 1}});
}

// Fails when every surface is taken for one, and when those that are none draw random numbers.
TEST_CASE("two pieces of glass that overlap are one, bounce by bounce", "[law]") {
    auto const film_of = [](std::string const& shapes) {
        auto const scene = test::scene_from(test::through_to_wall(20, nested_materials(), shapes));
        scene->render.max_bounces = 4;
        return test::rendered(*scene, "path", {.spp = 256, .seed = 8});
    };
    Film const one = film_of(test::wide_box("glass", 0, 2)),
               two = film_of(test::wide_box("glass", 0, 1.2) + "," + test::wide_box("glass", .8, 2));
    for (int y = 0; y < one.height(); ++y)
        for (int x = 0; x < one.width(); ++x) CHECK(two.mean(x, y).Y == Approx(one.mean(x, y).Y).epsilon(1e-5));
}

// Every path out brings n^2 of where the camera is, since nothing absorbs. Fails for index 1 outside every body
// (1.3^2 1.7^2), and for the camera taken to be outside.
TEST_CASE("in a furnace the radiance in nested bodies is the square of the index", "[law]") {
    auto const radiance_at = [](std::string const& eye, std::string const& integrator, double roughness) {
        auto const scene = test::scene_from(fmt::format(
            R"({{ "camera": {{ "eye": {}, "target": [0.1,0.2,3], "field_deg": 120 }}, "film": {{ "size": [8,8] }},
                 "materials": {{ "glass": {{ "type": "dielectric", "ior": 1.7, "priority": -1 }}, "water": {{ "type": "dielectric", "ior": 1.3, "roughness": {}, "priority": 4 }} }},
                 "objects": {{ "ball": [ {{ "type": "sphere", "centre": [0,0,0], "radius": 1, "material": "glass" }} ] }},
                 "instances": [ {{ "object": "ball", "transform": [ {{ "scale": [1, 1.3, 1] }} ] }} ],
                 "shapes": [ {{ "type": "sphere", "centre": [0,0,0.4], "radius": 0.5, "material": "water" }} ],
                 "lights": [ {{ "type": "environment", "radiance": 1 }} ] }})",
            eye, roughness));
        Film const film = test::rendered(*scene, integrator, {.spp = 512, .seed = 9});
        return test::measured(film);
    };
    for (char const* integrator : {"path", "reference_path"})
        for (double roughness : {0., .5})
            for (auto const& [eye, n] :
                 {std::pair("[0,0,0.3]", 1.3), std::pair("[0,0,-0.5]", 1.7), std::pair("[0,0,-4]", 1.)}) {
                auto const [mean, error] = radiance_at(eye, integrator, roughness);
                INFO(integrator << ", roughness " << roughness << ", from " << eye << ": " << mean.Y << " +- "
                                << error.Y);
                double const of_the_table = roughness > 0 ? 2e-3 * n * n : 0;  // see facet_loss.h
                CHECK(std::abs(mean.Y - n * n) < 4.5 * error.Y + of_the_table);
                CHECK(error.Y < 3e-3);
            }
}

// What has no inside gives a picture all the same: finite, and nothing dropped.
TEST_CASE("open bodies, bodies inside out and too many bodies make pictures without a rejected sample", "[law]") {
    std::string spheres, many;
    for (int i = 0; i < 12; ++i) {
        many +=
            fmt::format(R"("m{0}": {{ "type": "dielectric", "ior": {1}, "absorption_per_m": 0.1, "priority": {0} }}, )",
                        i, 1 + .05 * i);
        spheres += fmt::format(R"({{ "type": "sphere", "centre": [0,0,2], "radius": {}, "material": "m{}" }}, )",
                               1.5 - .1 * i, i);
    }
    std::string const open =
        R"({ "type": "cylinder", "from": [0,-1,1], "to": [0.3,1,1.5], "radius": 0.8, "caps": false, "material": "m1" },
        { "type": "quad", "corners": [[-9,-1,-9],[-9,-1,9],[9,-1,9],[9,-1,-9]], "material": "m2" },
        { "type": "sphere", "centre": [1,0,1], "radius": 1, "material": "m3", "flip": true },
        { "type": "sphere", "centre": [-1,0,1], "radius": 0.7, "material": { "type": "conductor", "ior": "Ag" } })";
    for (std::string const& shapes : {spheres + open, open}) {
        auto const scene = test::scene_from(fmt::format(
            R"({{ "camera": {{ "eye": [0,0.3,-4], "target": [0,0,1], "field_deg": 60 }}, "film": {{ "size": [24,24] }},
                 "materials": {{ {} "x": {{ "type": "black" }} }}, "shapes": [ {} ],
                 "lights": [ {{ "type": "environment", "radiance": 1 }} ] }})",
            many, shapes));
        CHECK(!scene->remarks.empty());
        for (char const* integrator : {"path", "reference_path"}) {
            Film const film = test::rendered(*scene, integrator, {.spp = 64, .seed = 2});
            CHECK(film.rejected() == std::array<std::uint64_t, rejection_count>{});
            CHECK(test::measured(film).mean.Y > .01);
            CHECK(test::measured(film).mean.Y < 1.5);
        }
    }
}
