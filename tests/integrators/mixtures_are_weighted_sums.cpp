// SPDX-License-Identifier: Apache-2.0
// A mixture looks like the weighted sum of its parts, whichever integrator; front and back of a two-sided material too.
#include <fmt/format.h>

#include <catch2/catch.hpp>

#include "support/scenes.h"

using namespace iride;

namespace {

constexpr double level = 4.5;  // standard errors: 1e-3 over 64 pixels and both integrators

// A sphere alone under a lamp and a sky: light is scattered once.
Film sphere_of(std::string const& materials, std::string const& integrator, std::uint64_t seed, int spp) {
    auto const scene = test::scene_from(fmt::format(
        R"({{ "camera": {{ "eye": [0,0,-4], "target": [0,0,0], "field_deg": 40 }}, "film": {{ "size": [8, 8] }},
             "render": {{ "sampler": "independent" }}, "materials": {{ {} }},
             "lights": [ {{ "type": "environment", "radiance": 0.5 }} ],
             "shapes": [ {{ "type": "sphere", "centre": [0,0,0], "radius": 1, "material": "it" }},
               {{ "type": "quad", "corners": [[-1,3,-2],[1,3,-2],[1,3,0],[-1,3,0]], "material": {{ "type": "black" }},
                  "emission": {{ "radiance": 6, "two_sided": true }} }} ] }})",
        materials));
    return test::rendered(*scene, integrator, {.spp = spp, .seed = seed, .sampler = SamplerKind::independent});
}

std::string const gold = R"("type": "conductor", "ior": "Au", "roughness": 0.3)";
std::string const red = R"("type": "diffuse", "reflectance": "cornell:red")";
std::string const glazed = R"("type": "plastic", "reflectance": "cornell:green")";

void check_sum(std::string const& mixture, std::vector<std::pair<double, std::string>> const& parts) {
    for (char const* integrator : {"path", "reference_path"}) {
        Film const mixed = sphere_of(mixture, integrator, 1, 4000);
        std::vector<Film> films;
        for (auto const& part : parts)
            films.push_back(sphere_of("\"it\": {" + part.second + "}", "path", 2 + films.size(), 2000));
        for (int y = 0; y < mixed.height(); ++y)
            for (int x = 0; x < mixed.width(); ++x)
                for (auto const component : {&Xyz::X, &Xyz::Z}) {
                    double expected = 0, variance = mixed.variance(x, y).*component;
                    for (std::size_t k = 0; k < parts.size(); ++k) {
                        expected += parts[k].first * films[k].mean(x, y).*component;
                        variance += square(parts[k].first) * films[k].variance(x, y).*component;
                    }
                    INFO(integrator << " at " << x << ", " << y);
                    CHECK(std::abs(mixed.mean(x, y).*component - expected) < level * std::sqrt(variance) + 1e-6);
                }
    }
}

}  // namespace

// Fails when each part is as likely as the other.
TEST_CASE("a mixture is the weighted sum of its parts", "[law]") {
    check_sum(fmt::format(R"("it": {{ "type": "mixture", "parts": [
                  {{ "material": {{ {} }}, "weight": 0.3 }}, {{ "material": {{ {} }}, "weight": 0.7 }} ] }})",
                          gold, red),
              {{.3, gold}, {.7, red}});
}

// Fails when the inner mixture reads the outer one's number as it is.
TEST_CASE("a mixture inside a mixture shares out its weight, in any order of names", "[law]") {
    check_sum(fmt::format(R"("it": {{ "type": "mixture", "parts": [
                  {{ "material": "inner", "weight": 0.6 }}, {{ "material": {{ {} }}, "weight": 0.4 }} ] }},
                "inner": {{ "type": "mixture", "parts": [ {{ "material": "red", "weight": 0.25 }},
                  {{ "material": {{ {} }}, "weight": 0.75 }} ] }}, "red": {{ {} }})",
                          gold, glazed, red),
              {{.4, gold}, {.45, glazed}, {.15, red}});
}

// Over many bounces: two greys are the grey between. L = Le / (1 - rho) in the uniform cube.
TEST_CASE("a mixture of two greys is the grey between them after many bounces too", "[law]") {
    for (char const* integrator : {"path", "reference_path"}) {
        auto const scene = test::scene_from(
            R"({ "camera": { "eye": [0,0,0], "target": [0,0,1], "field_deg": 60 }, "film": { "size": [8, 8] },
                 "shapes": [ { "type": "sphere", "centre": [0,0,0], "radius": 1, "flip": true, "emission": { "radiance": 1 },
                   "material": { "type": "mixture", "parts": [ { "material": { "type": "diffuse", "reflectance": 0.9 }, "weight": 0.5 },
                     { "material": { "type": "oren-nayar", "reflectance": 0.1, "roughness": 0 }, "weight": 0.5 } ] } } ] })");
        Film const film = test::rendered(*scene, integrator, {.spp = 512, .seed = 5});
        for (int y = 0; y < film.height(); ++y)
            for (int x = 0; x < film.width(); ++x)
                CHECK(std::abs(film.mean(x, y).Y - 2) < level * std::sqrt(film.variance(x, y).Y));
    }
}

// Fails for front and back exchanged.
TEST_CASE("a two-sided material shows its front in front and its back behind", "[law]") {
    for (auto const& [z, reflectance] : {std::pair(-3.0, .2), {3.0, .8}})
        for (bool flip : {false, true}) {
            // Seen from z > 0 the corners run counter-clockwise: that is the front.
            auto const scene = test::scene_from(fmt::format(
                R"({{ "camera": {{ "eye": [0,0,{}], "target": [0,0,0], "field_deg": 10 }}, "film": {{ "size": [4, 4] }},
                     "lights": [ {{ "type": "environment", "radiance": 1 }} ],
                     "shapes": [ {{ "type": "quad", "corners": [[-1,-1,0],[1,-1,0],[1,1,0],[-1,1,0]], "flip": {},
                       "material": {{ "type": "two-sided", "front": {{ "type": "diffuse", "reflectance": 0.8 }},
                                      "back": {{ "type": "diffuse", "reflectance": 0.2 }} }} }} ] }})",
                z, flip));
            double const expected = flip ? 1 - reflectance : reflectance;
            for (char const* integrator : {"path", "reference_path"}) {
                Film const film = test::rendered(*scene, integrator, {.spp = 64, .seed = 6});
                CHECK(film.mean(1, 2).Y == Approx(expected).margin(level * std::sqrt(film.variance(1, 2).Y) + 1e-4));
            }
        }
}
