// SPDX-License-Identifier: Apache-2.0
// Radiosity of two shipped rooms against `path`: means of every band of wavelengths, and pixel by pixel.
#include <catch2/catch.hpp>

#include "integrators/radiosity/radiosity.h"
#include "support/scenes.h"

using namespace iride;
using namespace iride::radiosity;

namespace {

constexpr int bands = 8;

std::unique_ptr<Scene> small(char const* name, int side) {
    auto scene = load_scene(find_scene(name));
    scene->film.width = scene->film.height = side;
    scene->film.band_count = bands;
    scene->film.band_range = {400, 720};
    return scene;
}

Film solved(Scene const& scene, Settings const& settings, int spp) {
    RenderPlan const plan = make_plan(scene);
    Film film = make_film(scene);
    render(scene, plan, *show(SceneRadiosity(scene, plan.wavelengths, settings).field()), {.spp = spp}, film);
    return film;
}

std::array<double, bands> means(Film const& film) {
    std::array<double, bands> mean{};
    for (int b = 0; b < bands; ++b)
        for (int y = 0; y < film.height(); ++y)
            for (int x = 0; x < film.width(); ++x)
                mean[static_cast<std::size_t>(b)] += film.band(x, y, b) / (film.width() * film.height());
    return mean;
}

void check_bands(char const* name, int patches, int rays, int spp) {
    auto const scene = small(name, 40);
    auto const found = means(solved(*scene, {.patches = patches, .wavelengths = 95, .fineness = rays}, 256)),
               traced = means(test::rendered(*scene, "path", {.spp = spp}));
    for (std::size_t b = 0; b < bands; ++b) {
        INFO(name << ", band " << b);
        CHECK(found[b] == Approx(traced[b]).epsilon(5e-3));
    }
}

}  // namespace

// Fails when lamps emit b instead of b / pi, for factors that do not close, and for bands shifted by one.
TEST_CASE("radiosity is as bright as path within half a per cent in every band", "[law]") {
    check_bands("cube-ceiling", 1000, 512, 3000);
}

// Nearly everything there stands on, leans against or runs into something else. Fails, by up to 3 %, when the mean of a
// patch is taken over what lies under a body too, or when insides of bodies that run into others count as lit.
TEST_CASE("the same of a furnished room", "[law]") { check_bands("room", 12000, 256, 1600); }

// What patches of this size cannot show is told by patches of half the size: where both agree, so must path.
// Fails, for 47 pixels of 1024, when 12 wavelengths are to stand for all.
TEST_CASE("pixels of radiosity are those of path but for the size of patches", "[law]") {
    auto const scene = small("cube-ceiling", 32);
    Film const coarse = solved(*scene, {.patches = 600, .wavelengths = 95, .fineness = 1024}, 64),
               fine = solved(*scene, {.patches = 2400, .wavelengths = 95, .fineness = 1024}, 64),
               traced = test::rendered(*scene, "path", {.spp = 512, .sampler = SamplerKind::independent});
    int beyond = 0;
    for (int y = 0; y < fine.height(); ++y)
        for (int x = 0; x < fine.width(); ++x) {
            double const of_size = std::abs(fine.mean(x, y).Y - coarse.mean(x, y).Y),
                         noise = std::sqrt(traced.variance(x, y).Y + fine.variance(x, y).Y);
            beyond += std::abs(fine.mean(x, y).Y - traced.mean(x, y).Y) > 3.3 * noise + of_size;
        }
    CHECK(beyond <= 10);  // 1 expected of 1024
}
