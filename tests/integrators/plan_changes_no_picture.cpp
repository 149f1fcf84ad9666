// SPDX-License-Identifier: Apache-2.0
// What the plan leaves out is not in the picture: with a decision switched off the picture is the same, bit by bit
// where the random numbers mean the same, else in the mean.
#include <catch2/catch.hpp>

#include "integrators/plan_disable.h"
#include "support/scenes.h"

using namespace iride;

namespace {

std::unique_ptr<Scene> small_scene(std::string const& name) {
    auto scene = load_scene(find_scene(name));
    scene->film.width = 40;
    scene->film.height = 30;
    return scene;
}

Film rendered_without(std::vector<std::string> const& disabled, Scene& scene) {
    RenderPlan const plan = make_plan_without(disabled, scene);
    Film film = make_film(scene);
    render(scene, plan, *make_integrator("path", scene, plan), {.spp = 16, .seed = 3}, film);
    return film;
}
Film rendered_without(std::vector<std::string> const& disabled, std::string const& name) {
    return rendered_without(disabled, *small_scene(name));
}

struct Mean {
    double Y = 0, variance = 0;
};
Mean mean_of(Film const& film) {
    Mean m;
    double const n = film.width() * film.height();
    for (int y = 0; y < film.height(); ++y)
        for (int x = 0; x < film.width(); ++x) {
            m.Y += film.mean(x, y).Y / n;
            m.variance += film.variance(x, y).Y / (n * n);
        }
    return m;
}

}  // namespace

// Fails if "uv and tangents" also turned the frame of isotropic materials, and if "wavelengths" cut a lamp's range.
TEST_CASE("a decision of the plan that is switched off changes no picture", "[law]") {
    for (char const* name : {"cornell", "metals", "metals-furnace", "glass-spheres", "textures", "glass-of-cordial"}) {
        Film const planned = rendered_without({}, name);
        for (PlanSwitch const& off : plan_switches()) {
            INFO(name << " without " << off.name);
            Film const carried = rendered_without({off.name}, name);
            Mean const a = mean_of(planned), b = mean_of(carried);
            if (off.same_picture) {
                bool same = true;
                for (int y = 0; y < planned.height(); ++y)
                    for (int x = 0; x < planned.width(); ++x) {
                        Xyz const p = planned.mean(x, y), q = carried.mean(x, y);
                        same = same && p.X == q.X && p.Y == q.Y && p.Z == q.Z;
                    }
                CHECK(same);
            } else {
                CHECK(std::abs(a.Y - b.Y) < 4 * std::sqrt(a.variance + b.variance));
            }
        }
    }
}

// A ball that sees nothing but the sky: |cos| over its density is the same in every direction.
TEST_CASE("under light from everywhere alike a diffuse ball has no noise but that of wavelengths", "[law]") {
    auto const scene = test::scene_from(
        R"({ "camera": { "eye": [0,0,-9], "target": [0,0,0], "field_deg": 2 }, "film": { "size": [8, 8] },
             "shapes": [ { "type": "sphere", "centre": [0,0,0], "radius": 1, "material": { "type": "diffuse", "reflectance": 0.6 } } ],
             "lights": [ { "type": "environment", "radiance": 1 } ] })");
    Film const left = rendered_without({}, *scene), asked = rendered_without({"uniform light"}, *scene);
    CHECK(mean_of(left).Y == Approx(0.6).epsilon(1e-3));
    CHECK(mean_of(asked).Y == Approx(0.6).epsilon(0.03));
    CHECK(mean_of(asked).variance > 100 * mean_of(left).variance);
}

TEST_CASE("what the scene needs cannot be switched off, and an unknown decision is refused", "[input]") {
    auto const prism = small_scene("prism");
    RenderPlan const plan = make_plan_without({"dispersion"}, *prism);
    CHECK(plan.dispersion);
    CHECK(!plan.decisions.back().used);
    CHECK_THROWS_WITH(make_plan_without({"dispersoin"}, *prism),
                      Catch::Matchers::Contains("did you mean 'dispersion'?"));
}
