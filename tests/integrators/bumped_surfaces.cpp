// SPDX-License-Identifier: Apache-2.0
// Turned normals neither make light nor let it through a surface; what they lose is what the closed form says.
#include <catch2/catch.hpp>

#include "base/picture.h"
#include "integrators/shading_normal.h"
#include "support/scenes.h"

using namespace iride;

namespace {

// Mean luminance of the film, and its standard error.
std::pair<double, double> mean_luminance(Film const& film) {
    double sum = 0, variance = 0;
    int const pixels = film.width() * film.height();
    for (int y = 0; y < film.height(); ++y)
        for (int x = 0; x < film.width(); ++x) {
            sum += film.mean(x, y).Y;
            variance += film.variance(x, y).Y;
        }
    return {sum / pixels, std::sqrt(variance) / pixels};
}

std::string furnace(std::string const& shape, std::string const& material, double window) {
    return R"({ "camera": { "type": "orthographic", "eye": [0,0,5], "target": [0,0,0], "window": )" +
           std::to_string(window) + R"( }, "film": { "size": [24, 24] },
        "shapes": [ { )" +
           shape + R"(, "material": )" + material + R"( } ],
        "lights": [ { "type": "environment", "radiance": 1 } ] })";
}
std::string const plane = R"("type": "quad", "corners": [[-1,-1,0],[1,-1,0],[1,1,0],[-1,1,0]])";

}  // namespace

// A white Lambert surface whose normal is turned by t away from the true one: of the light it should reflect, that from
// below the surface is missing, (1 - cos t) / 2: with samples kept there, or weighed again, the mean would be 1.
TEST_CASE("a turned normal loses what it would have had from below the surface, and no more", "[law]") {
    test::TemporaryFolder const folder;
    // 2 rgb - 1 = (.6, 0, .8) but for the rounding of 8 bits.
    write_png(folder.path() / "turned.png", 1, 1, std::vector<std::uint8_t>{204, 128, 230});
    auto const scene = load_scene(folder.write(
        "scene.json",
        furnace(plane, R"({ "type": "diffuse", "reflectance": 1, "normal_map": { "image": "turned.png" } })", .8)));
    for (char const* integrator : {"path", "reference_path"}) {
        INFO(integrator);
        auto const [mean, error] = mean_luminance(test::rendered(*scene, integrator, {.spp = 64}));
        CHECK(mean == Approx(.9).margin(.002 + 4 * error));
    }
}

// Never above 1; the mean over the sphere's disc is what is told in docs/architecture.md.
TEST_CASE("a bumped white sphere in a white furnace is never brighter than the furnace", "[law]") {
    std::string const sphere = R"("type": "sphere", "centre": [0,0,0], "radius": 1)";
    for (auto const& [height, least] : {std::pair(.002, .995), {.01, .95}, {.05, .75}}) {
        auto const scene = test::scene_from(
            furnace(sphere,
                    R"({ "type": "diffuse", "reflectance": 1, "bump": { "waves": [16, 8], "height": )" +
                        std::to_string(height) + "} }",
                    .68));
        Film const film = test::rendered(*scene, "path", {.spp = 64});
        auto const [mean, error] = mean_luminance(film);
        INFO("height " << height << ": " << mean << " +- " << error);
        CHECK(mean <= 1 + 3 * error);
        CHECK(mean > least);
        for (int y = 0; y < film.height(); ++y)
            for (int x = 0; x < film.width(); ++x)
                CHECK(film.mean(x, y).Y <= 1 + 4.5 * std::sqrt(film.variance(x, y).Y) + 1e-5);
    }
}

// Mirrored into the surface, a direction would be dropped.
TEST_CASE("a bumped mirror has no black fringes", "[law]") {
    auto const scene = test::scene_from(furnace(
        R"("type": "sphere", "centre": [0,0,0], "radius": 1)",
        R"({ "type": "conductor", "ior": { "n": 0.001, "k": 100 }, "bump": { "waves": [16, 8], "height": 0.01 } })",
        .7));
    Film const film = test::rendered(*scene, "path", {.spp = 16});
    double darkest = 1;
    for (int y = 0; y < film.height(); ++y)
        for (int x = 0; x < film.width(); ++x) darkest = std::min(darkest, film.mean(x, y).Y);
    CHECK(darkest > .99);
}

TEST_CASE("a normal that is good is not bent, and a bent one mirrors the viewer out of the surface", "[unit]") {
    Direction const g(0, 0, 1);
    for (float turn = -1.5f; turn < 1.5f; turn += .1f)
        for (float look = -1.55f; look < 1.55f; look += .1f) {
            Direction const n(std::sin(turn), 0, std::cos(turn)), wo(std::sin(look), 0, std::cos(look));
            Direction const bent = bent_to_viewer(n, g, wo), mirrored = 2 * bent.dot(wo) * bent - wo;
            INFO(turn << " " << look);
            CHECK(mirrored.z() >= std::min(.01f, wo.z()) - 1e-5f);
            CHECK(bent.dot(wo) > 0);
            CHECK(bent.z() > 0);
            if ((2 * n.dot(wo) * n - wo).z() > .011f) CHECK(bent == n);
        }
}
