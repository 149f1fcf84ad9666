// SPDX-License-Identifier: Apache-2.0
// Between two places of surfaces nothing stands but what is there: not the surfaces themselves, however close they are
// and however far from the origin, where floats are coarse.
#include <fmt/format.h>

#include <catch2/catch.hpp>

#include "support/scenes.h"

using namespace iride;
using namespace iride::test;

namespace {

// Sheets of 1 m by 1 m at heights above (x, x, x): the lowest looks up, the others down.
std::unique_ptr<Scene> sheets(double x, std::vector<double> const& heights) {
    std::string shapes;
    for (double h : heights) {
        double const y = x + h;
        char const* const corners =
            h == 0 ? R"({{ "type": "quad", "corners": [[{0},{1},{0}],[{0},{1},{2}],[{2},{1},{2}],[{2},{1},{0}]], )"
                   : R"(, {{ "type": "quad", "corners": [[{0},{1},{0}],[{2},{1},{0}],[{2},{1},{2}],[{0},{1},{2}]], )";
        shapes += fmt::format(fmt::runtime(corners), x, y, x + 1);
        shapes += R"("material": { "type": "diffuse", "reflectance": 0.5 }, "emission": { "radiance": 1 } })";
    }
    return scene_from(fmt::format(
        R"({{ "camera": {{ "eye": [0,0,0], "target": [0,0,1], "field_deg": 40 }}, "film": {{ "size": [4, 4] }}, "shapes": [{}] }})",
        shapes));
}

// How many of 1000 rays from the first sheet to the last are stopped: those that arrive no flatter than 1 in 5.
struct Stopped {
    int count = 0, of = 0;
};
Stopped stopped(Scene const& scene, double x) {
    Stopped stopped;
    RayStatistics rays;
    Vector const low = Vector::Constant(static_cast<float>(x)) - scene.origin.cast<float>();
    Light const& lamp = scene.lights.light(static_cast<int>(scene.lights.size()) - 1);
    Wavelengths const w = WavelengthSampler(visible_range, visible_importance(), scene.grid).sample(0.5f);
    for (std::uint32_t i = 0; i < 1000; ++i) {
        Sampler random(SamplerKind::independent, 4, 0, i);
        Sample2 const at = random.next2();
        auto const hit = scene.accelerator->closest(Ray{low + Vector(at.x, 0.001f, at.y), Direction(0, -1, 0)}, rays);
        REQUIRE(hit);
        auto const sample = lamp.sample(hit->point.position, w, random.next2());
        if (!sample || sample->wi.y() < 0.2f) continue;
        ++stopped.of;
        stopped.count +=
            scene.accelerator->occluded(spawn_shadow_ray(hit->point, sample->wi, sample->distance), rays) ? 1 : 0;
    }
    return stopped;
}

}  // namespace

// Fails if the step off the first surface is forgotten where the ray ends: then the lamp shades what is closer to it
// than 8 % of its distance from the origin.
TEST_CASE("a lamp lights what is close to it, wherever the two are", "[law]") {
    for (double x : {0.0, 2.0, 50.0})
        for (double height : {1.0, 0.1, 0.02}) {
            INFO(height << " m apart at " << x << " m");
            Stopped const open = stopped(*sheets(x, {0, height}), x),
                          shut = stopped(*sheets(x, {0, height / 2, height}), x);
            CHECK(open.count == 0);
            CHECK(open.of > 10);
            CHECK(shut.count == shut.of);
        }
}
