// SPDX-License-Identifier: Apache-2.0
// Light paths aimed at mirrors and glass: their density is one, is the one that is sampled, and with it `caustic-path`
// brings the light that path tracing brings.
#include <algorithm>

#include "base/random.h"
#include "integrators/light_emission_choice.h"
#include "support/agreement.h"

using namespace iride;
using namespace iride::test;

namespace {

std::string const gold = R"({ "type": "conductor", "ior": "Au", "roughness": 0.1 })",
                  glass = R"({ "type": "dielectric", "ior": { "pairs": [[300, 1.7], [900, 1.4]] } })";

// Gold, glass and an instance of a metal; two lamps and a point.
std::string with_targets() {
    return scene_text(
        view,
        R"("objects": { "bolt": [ { "type": "cylinder", "from": [0,0,0], "to": [0,0.5,0], "radius": 0.1, "material": )" +
            gold +
            R"( } ] }, "instances": [ { "object": "bolt", "transform": [ { "scale": [1, 2, 1] }, { "translate": [-1.2, 0, 0] } ] } ],
                  "shapes": [)" +
            floor_quad + "," + lamp + "," + big_lamp_sphere + "," + sphere(gold) +
            R"(, { "type": "sphere", "centre": [1.2,0.4,-0.5], "radius": 0.4, "material": )" + glass +
            R"( } ], "lights": [ { "type": "point", "position": [-1,2,-2], "intensity": 3 } ])");
}

void check_agreement(std::string const& text, std::string const& oracle, int spp, int oracle_spp) {
    auto const scene = scene_from(text);
    for (char const* integrator : {"caustic-path", "caustic-path:light_paths=1"})
        test::check_agreement(*scene,
                              {.integrator = integrator, .oracle = oracle, .spp = spp, .oracle_spp = oracle_spp});
}

}  // namespace

// Fails if of cones that overlap only one counts.
TEST_CASE("the density of aimed light is that of its samples and integrates to 1 over lamps and directions", "[law]") {
    auto const scene = scene_from(with_targets());
    AimedEmission const aimed(*scene);
    REQUIRE(aimed.has_targets());
    Ball const ball{scene->centre(), scene->radius()};
    Wavelengths const w = wavelengths_at(LaneRegister{} + 550, scene->grid);
    // A uniform direction from a uniform place of each light; what a sample has, the place has.
    constexpr int count = 1 << 20;
    double sum = 0, squares = 0;
    int lit = 0;
    for (int i = 0; i < count; ++i) {
        Sampler sampler(SamplerKind::independent, 5, static_cast<std::uint32_t>(i), 0);
        float const choice = sampler.next();
        Sample2 const place = sampler.next2(), direction = sampler.next2(), uniform = sampler.next2();
        if (auto const start = aimed.start(*scene, ball, w, choice, place, direction)) {
            ++lit;
            EmissionSample const& e = start->sample;
            float const cosine = e.travel.dot(e.from.geometric_normal);
            REQUIRE(aimed.density(*scene, ball, start->light, e.from.position, e.travel, cosine) ==
                    Approx(start->probability * e.density.product()).epsilon(1e-5));
        }
        double total = 0;
        for (int l = 0; l < static_cast<int>(scene->lights.size()); ++l) {
            auto const emitted = scene->lights.light(l).emit(ball, w, place, {.25f, .5f});
            Direction const travel = to_sphere(uniform);
            float const area = emitted->density.area.value;
            total += 4 * pi_double *
                     static_cast<double>(aimed.density(*scene, ball, l, emitted->from.position, travel, 1) / area);
        }
        sum += total;
        squares += square(total);
    }
    double const mean = sum / count, error = std::sqrt((squares / count - square(mean)) / count);
    INFO(mean << " +- " << error << ", of which shine: " << lit / double(count));
    CHECK(std::abs(mean - 1) < 4 * error);
    CHECK(error < 5e-3);
    CHECK(lit > count / 4);
}

TEST_CASE("many small mirrors are aimed at together, and none is left out", "[unit]") {
    std::string shapes = lamp;
    for (int i = 0; i < 100; ++i)
        shapes += fmt::format(R"(, {{ "type": "sphere", "centre": [{}, {}, {}], "radius": 0.05, "material": {} }})",
                              i % 10, i / 10 % 3, i / 30, gold);
    auto const scene = scene_from(scene_text(view, R"("shapes": [)" + shapes + "]"));
    std::vector<Ball> const balls = caustic_targets(*scene);
    CHECK(balls.size() <= 32);
    for (Shape const& s : scene->shapes)
        if (auto const* const mirror = std::get_if<Sphere>(&s.geometry))
            CHECK(std::ranges::any_of(balls, [&](Ball const& b) {
                return (mirror->centre - b.centre).norm() + mirror->radius <= b.radius * (1 + 1e-6f);
            }));
}

// Fails if a light path's own density is left out of the weights, at s = 0, at s = 1 or at t = 1, or is that of the
// lamp's own emission; and if joins of inner vertices, which nobody makes, are counted among the techniques.
TEST_CASE("caustic-path agrees: gold, an instance and glass under lamps and a point", "[law]") {
    check_agreement(with_targets(), "bidirectional", 2500, 2500);
}
// Fails also if from inside a ball only half the directions are drawn.
TEST_CASE("caustic-path agrees: mirrors that see one another, and a lamp among them", "[law]") {
    check_agreement(
        scene_text(view, R"("shapes": [)" + floor_quad + "," + lamp + "," + big_lamp_sphere + "," + sphere(gold) +
                             R"(, { "type": "box", "min": [-2.5,-0.5,-5], "max": [2.5,3,2], "flip": true, "material": )"
                             R"({ "type": "conductor", "ior": "Ag", "roughness": 0.4 } } ])"),
        "path", 2500, 4000);
}
TEST_CASE("caustic-path agrees: dispersive glass under a rectangle and sky", "[law]") {
    check_agreement(scene_text(view, R"("lights": [{ "type": "environment", "radiance": 0.3 }], "shapes": [)" +
                                         floor_quad + "," + lamp + "," + sphere(glass) + "]"),
                    "reference_path", 1500, 12000);
}

TEST_CASE("caustic-path needs a lamp of a place and a mirror or a glass", "[input]") {
    auto const refusal = [](std::string const& rest) {
        auto const scene = scene_from(scene_text(view, rest));
        try {
            make_integrator("caustic-path", *scene, make_plan(*scene));
        } catch (InputError const& e) {
            return std::string(e.what());
        }
        return std::string("(accepted)");
    };
    using Catch::Matchers::Contains;
    CHECK_THAT(refusal(R"("shapes": [)" + floor_quad + "," + lamp + "]"), Contains("shines at a mirror or a glass"));
    CHECK_THAT(refusal(R"("lights": [{ "type": "environment", "radiance": 1 }], "shapes": [)" + sphere(gold) + "]"),
               Contains("no lamp of a place shines"));
    CHECK(refusal(R"("shapes": [)" + sphere(gold) + "," + lamp + "]") == "(accepted)");
}
