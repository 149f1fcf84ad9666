// SPDX-License-Identifier: Apache-2.0
// Light samples follow their stated density, and density() agrees with sample(). Fails for a sphere sampled over its
// whole surface with the cone's density, and for a rectangle sampled by area with 1 / solid angle.
#include <catch2/catch.hpp>

#include "support/scenes.h"
#include "support/statistics.h"

using namespace iride;

namespace {

void check_light(std::string const& shape, Vector const& from) {
    auto const scene = test::scene_from(
        R"({ "camera": { "eye": [0,0,-9], "target": [0,0,0], "field_deg": 30 }, "shapes": [ { "material": { "type": "black" }, "emission": { "radiance": 1, "two_sided": true }, )" +
        shape + " } ] }");
    WavelengthSampler const wavelengths(visible_range, visible_importance(), scene->grid);
    Wavelengths const w = wavelengths.sample(0.3f);
    Light const& light = scene->lights.light(0);
    RayStatistics statistics;
    test::DirectionHistogram histogram(40, 80);
    constexpr int samples = 400000;
    for (std::uint32_t i = 0; i < samples; ++i) {
        Sampler s(SamplerKind::independent, 21, 0, i);
        auto const x = light.sample(from, w, s.next2());
        if (!x) {
            histogram.add_nothing();
            continue;
        }
        histogram.add(x->wi);
        if (i % 64 != 0) continue;
        // What scattering would find in that direction has the same density.
        auto const hit = scene->accelerator->closest({from, x->wi}, statistics);
        if (!hit || std::abs(hit->distance - x->distance) > 1e-3f * x->distance) continue;  // a far side, or the rim
        REQUIRE(light.density(from, hit->point, hit->primitive).value == Approx(x->density->value).epsilon(2e-2));
    }
    INFO(shape);
    auto const density = [&](Direction const& wi) {
        auto const hit = scene->accelerator->closest({from, wi}, statistics);
        return hit ? static_cast<double>(light.density(from, hit->point, hit->primitive).value) : 0.0;
    };
    CHECK(histogram.integral_of(density, 24) == Approx(1).epsilon(0.01));
    CHECK(histogram.p_value(density, 24) > 1e-5);
}

}  // namespace

TEST_CASE("a rectangle lamp is sampled uniformly in solid angle", "[law]") {
    check_light(R"("type": "quad", "corners": [[-1,1,-1],[1,1,-1],[1,1,1.5],[-1,1,1.5]])", {0.3f, 0, 0.2f});
}
TEST_CASE("a crooked quad lamp is sampled by its two triangles", "[law]") {
    check_light(R"("type": "quad", "corners": [[-1,1,-1],[1.4,1,-0.8],[1,1,1.5],[-1.2,1,1]])", {0.1f, 0, 0.2f});
}
TEST_CASE("a sphere lamp is sampled uniformly in its cone", "[law]") {
    check_light(R"("type": "sphere", "centre": [0.3,1.5,0.2], "radius": 0.9)", {0, 0, 0});
}
TEST_CASE("a disc lamp is sampled by area", "[law]") {
    check_light(R"("type": "disc", "centre": [0.3,1.1,0.2], "normal": [0.2,-1,0.1], "radius": 0.9)", {0, 0, 0});
}
TEST_CASE("a triangle lamp is sampled uniformly in solid angle", "[law]") {
    check_light(R"("type": "mesh", "vertices": [[-1,1,-1],[1.4,1.2,-0.8],[0.3,0.9,1.5]], "triangles": [[0,1,2]])",
                {0.1f, 0, 0.2f});
}

TEST_CASE("a far sphere lamp gives the irradiance pi L (r / d)^2", "[law]") {
    auto const scene = test::scene_from(
        R"({ "camera": { "eye": [0,5,0], "target": [0,0,0], "up": [0,0,1], "field_deg": 0.1 }, "film": { "size": [2,2] },
        "shapes": [ { "type": "quad", "corners": [[-1,0,-1],[-1,0,1],[1,0,1],[1,0,-1]], "material": { "type": "diffuse", "reflectance": 1 } },
                    { "type": "sphere", "centre": [0,200,0], "radius": 1, "material": { "type": "black" }, "emission": { "radiance": 10000 } } ] })");
    Film const film = test::rendered(*scene, "path", {.spp = 4096, .seed = 6});
    CHECK(film.mean(0, 0).Y == Approx(10000.0 / (200.0 * 200)).epsilon(2e-3));
}
