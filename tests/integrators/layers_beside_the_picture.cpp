// SPDX-License-Identifier: Apache-2.0
// Layers against closed forms: a ball before an orthographic camera, and a furnace whose light is a geometric series.
#include "integrators/layers.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <map>

#include "film/cryptomatte.h"
#include "support/scenes.h"

using namespace iride;

namespace {

// The layers of a scene, by channel.
std::map<std::string, std::vector<float>> layers_of(Scene const& scene, std::vector<std::string> const& names,
                                                    int spp) {
    RenderPlan const plan = make_plan(scene);
    RenderSettings const settings{.spp = spp, .seed = 1};
    Film film = make_film(scene);
    render(scene, plan, *make_integrator("path", scene, plan), settings, film);
    ExrSettings of;
    of.colourspace = "linear-sRGB";
    of.scene_white = scene.film.white;
    std::map<std::string, std::vector<float>> channels;
    for (auto& [name, value] : make_layers(names, scene, plan, "path", settings, film, of).channels)
        channels[name] = std::move(value);
    return channels;
}

}  // namespace

// Fails with the distance along the ray for a perspective camera's depth, with normals of the far side, and with an
// albedo lit by a light of equal energy (red 1.2 times too much).
TEST_CASE("first hits of a ball are those of the sphere", "[law]") {
    auto const scene = test::scene_from(R"({
      "camera": { "type": "orthographic", "eye": [0,0,5], "target": [0,0,0], "window": 2 },
      "film": { "size": [32, 32] },
      "materials": { "ball": { "type": "diffuse", "reflectance": 0.5 } },
      "shapes": [{ "type": "sphere", "centre": [0,0,0], "radius": 1, "material": "ball" }],
      "lights": [{ "type": "environment", "radiance": 1 }] })");
    auto const c = layers_of(*scene, {"depth", "position", "normal", "albedo", "material", "count"}, 64);
    int wrong = 0;
    double mean_albedo = 0, inside = 0, coverage = 0;
    for (std::size_t i = 0; i < 1024; ++i) {
        double const x = (static_cast<double>(i % 32) + .5) / 8 - 2, y = 2 - (static_cast<double>(i / 32) + .5) / 8;
        double const r2 = x * x + y * y, diagonal = .09;  // half of a pixel's
        coverage += static_cast<double>(c.at("CryptoMaterial00.G")[i]) / 64;
        if (std::sqrt(r2) > 1 + diagonal) {
            wrong += !std::isinf(c.at("depth.Z")[i]) || c.at("CryptoMaterial00.G")[i] != 0 || c.at("N.Z")[i] != 0;
        } else if (std::sqrt(r2) < .8) {
            double const z = std::sqrt(1 - r2);
            auto const near = [&](char const* name, double value, double margin) {
                return std::abs(static_cast<double>(c.at(name)[i]) - value) < margin;
            };
            bool const good = near("depth.Z", 5 - z, .13) && near("N.X", x, .02) && near("N.Y", y, .02) &&
                              near("N.Z", z, .02) && near("Ng.Z", z, .02) && near("position.X", x, .07) &&
                              near("CryptoMaterial00.G", 1, 1e-6);
            wrong +=
                !good || c.at("CryptoMaterial00.R")[i] != id_as_float(cryptomatte_id("ball")) || c.at("count")[i] != 64;
            mean_albedo += static_cast<double>(c.at("albedo.R")[i]);
            ++inside;
        }
    }
    CHECK(wrong == 0);
    CHECK(mean_albedo / inside == Approx(.5).epsilon(.01));
    // The ball's share of 4 x 4 m^2, in units of 64 pixels.
    CHECK(coverage == Approx(pi_double).epsilon(.005));
}

// Le (1 + rho) of Le / (1 - rho), rho = 1/2. Fails when the second scattering's light is among the direct.
TEST_CASE("direct light in a furnace is the first two terms of the series", "[law]") {
    auto const scene = load_scene(find_scene("cube-uniform"));
    scene->film.width = scene->film.height = 16;
    auto const c = layers_of(*scene, {"direct", "indirect"}, 256);
    double direct = 0, rest = 0;
    for (std::size_t i = 0; i < 256; ++i) {
        direct += static_cast<double>(c.at("direct.G")[i]) / 256;
        rest += static_cast<double>(c.at("indirect.G")[i]) / 256;
    }
    // Radiance 1 at every wavelength is grey but for a D65 white: its luminance is compared.
    CHECK(direct / (direct + rest) == Approx(.75).epsilon(.005));
}
