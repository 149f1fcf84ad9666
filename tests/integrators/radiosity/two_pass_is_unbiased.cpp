// SPDX-License-Identifier: Apache-2.0
// `two-pass` against `path` by a z-test, with the radiosity it has and with wrong ones: the mean does not depend on it.
#include "integrators/radiosity/two_pass.h"

#include <catch2/catch.hpp>

#include "support/agreement.h"

using namespace iride;
using namespace iride::radiosity;

namespace {

// A solution whose values are replaced by `wrong`, vertex by vertex.
template <class Wrong>
std::shared_ptr<RadiosityField const> spoilt(Scene const& scene, WavelengthRange const& range, Wrong const& wrong) {
    SceneRadiosity const solution(scene, range, {.patches = 100, .wavelengths = 8, .fineness = 64});
    auto const right = solution.field_of(solution.reflected());
    RadiosityField::AtVertex values = right->at_vertex();
    for (Eigen::Index v = 0; v < values.rows(); ++v)
        for (Eigen::Index w = 0; w < values.cols(); ++w) values(v, w) = wrong(v, values(v, w));
    return std::make_shared<RadiosityField>(right->mesh(), right->wavelengths_nm(), values);
}

Film by_two_passes(Scene const& scene, std::shared_ptr<RadiosityField const> known, TwoPassSettings const& how) {
    RenderPlan const plan = make_plan(scene);
    Film film = make_film(scene);
    render(scene, plan, *two_pass(scene, plan, std::move(known), how),
           {.spp = 3000, .seed = 21, .sampler = SamplerKind::independent}, film);
    return film;
}

Film traced(Scene const& scene) {
    return test::rendered(scene, "path", {.spp = 3000, .seed = 22, .sampler = SamplerKind::independent});
}

std::string const walls =
    R"({ "type": "quad", "corners": [[-3,0,3],[-3,4,3],[3,4,3],[3,0,3]], "material": { "type": "diffuse", "reflectance": "cornell:green" } })";

}  // namespace

// Fails when what was gathered is not taken off again along the path that goes on, when that does not count 1 / q
// times, and when a lamp that it finds is weighed as if it always went on.
TEST_CASE("two passes agree with path, however wrong the radiosity", "[law]") {
    auto const scene = test::scene_from(
        test::scene_text(test::view, R"("shapes": [)" + test::floor_quad + "," + walls + "," + test::lamp + "," +
                                         test::sphere(R"({ "type": "diffuse", "reflectance": "cornell:red" })") + "]"));
    WavelengthRange const range = make_plan(*scene).wavelengths;
    Film const reference = traced(*scene);
    test::check_films_agree(by_two_passes(*scene, spoilt(*scene, range, [](auto, float b) { return b; }), {}),
                            reference);
    test::check_films_agree(
        by_two_passes(*scene, spoilt(*scene, range, [](auto, float b) { return 3 * b; }), {.rays = 2, .go_on = .5f}),
        reference);
    test::check_films_agree(
        by_two_passes(
            *scene,
            spoilt(*scene, range, [](Eigen::Index v, float) { return static_cast<float>(hash_words(v) % 100) * .01f; }),
            {.rays = 1, .go_on = .2f}),
        reference);
}

// A mirror, a gloss and a sky: what the patches take for diffuse is corrected.
TEST_CASE("two passes agree with path where surfaces are not diffuse", "[law]") {
    auto const scene = test::scene_from(test::scene_text(
        test::view,
        R"("lights": [{ "type": "environment", "radiance": 0.3 }], "shapes": [)" + test::floor_quad + "," + walls +
            "," + test::big_lamp_sphere + "," +
            R"({ "type": "sphere", "centre": [-1,0.5,0.3], "radius": 0.5, "material": { "type": "conductor", "ior": "Au" } },)" +
            test::sphere(R"({ "type": "plastic", "reflectance": 0.5, "roughness": 0.2 })") + "]"));
    WavelengthRange const range = make_plan(*scene).wavelengths;
    test::check_films_agree(by_two_passes(*scene, spoilt(*scene, range, [](auto, float b) { return 2 * b; }), {}),
                            traced(*scene));
}

TEST_CASE("two passes refuse what they do not know", "[input]") {
    using Catch::Contains;
    auto const scene = load_scene(find_scene("cube-ceiling"));
    RenderPlan const plan = make_plan(*scene);
    for (auto const& [asked, said] : {std::pair("two-pass:go_on=0", "go_on"),
                                      {"two-pass:rays=0", "rays"},
                                      {"two-pass:patchs=9", "did you mean 'patches'"}}) {
        INFO(asked);
        CHECK_THROWS_WITH(make_integrator(asked, *scene, plan), Contains(said));
    }
}
