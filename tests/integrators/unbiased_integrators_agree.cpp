// SPDX-License-Identifier: Apache-2.0
// Every unbiased integrator against every other on six scenes: pixel by pixel within the noise that the films claim,
// and the mean of the picture to .2 %, at a standard error that can tell. What an integrator leaves out by its
// definition (mirror images in `light-tracing`, all but direct light in `direct`) it is not asked for.
#include <fmt/format.h>

#include <catch2/catch.hpp>

#include "support/agreement.h"

using namespace iride;
using namespace iride::test;

namespace {

std::string const back_wall =
    R"({ "type": "quad", "corners": [[-3,0,2],[-3,4,2],[3,4,2],[3,0,2]], "material": { "type": "diffuse", "reflectance": "cornell:red" } })";
std::string const small_sphere_lamp =
    R"({ "type": "sphere", "centre": [-1.1,1.9,-0.6], "radius": 0.3, "material": { "type": "black" }, "emission": { "radiance": { "data": "D65", "luminance_weighted": 9 } } })";

std::string quad_lamp(double x, double luminance) {
    return fmt::format(
        R"({{ "type": "quad", "corners": [[{0},2.5,-0.4],[{1},2.5,-0.4],[{1},2.5,0.4],[{0},2.5,0.4]], "material": {{ "type": "black" }}, "emission": {{ "radiance": {{ "data": "D65", "luminance_weighted": {2} }} }} }})",
        x - 0.4, x + 0.4, luminance);
}
std::string shapes(std::vector<std::string> const& all) {
    return fmt::format(R"("shapes": [{}])", fmt::join(all, ", "));
}
// A ball of few facets with the normals of a round one, of glass.
std::string const facets =
    R"({ "type": "mesh", "file": "ball.obj", "material": { "type": "dielectric", "ior": 1.5 } })";

struct SceneTrial {
    char const* scene;  // shipped, or a name for `text`
    std::string text;
    std::vector<char const*> integrators;  // against the first
};

std::vector<SceneTrial> const trials{
    {"glass-spheres", "", {"bidirectional", "path", "bidirectional-power", "auto"}},
    {"prism", "", {"path", "reference_path", "bidirectional", "auto"}},
    {"three lamps of different power",
     shapes({floor_quad, back_wall, quad_lamp(-1.4, 0.5), quad_lamp(0, 3), quad_lamp(1.4, 12),
             sphere(R"({ "type": "conductor", "ior": "Au", "roughness": 0.3 })")}),
     {"path", "bidirectional", "bidirectional-power", "light-tracing", "auto"}},
    {"a sphere lamp",
     shapes({floor_quad, back_wall, small_sphere_lamp,
             sphere(R"({ "type": "plastic", "reflectance": 0.5, "roughness": 0.3 })")}),
     {"path", "bidirectional", "bidirectional-power", "light-tracing"}},
    {"a lamp behind glass",
     shapes(
         {floor_quad, back_wall, quad_lamp(0, 6), sphere(R"({ "type": "diffuse", "reflectance": 0.6 })"),
          R"({ "type": "box", "min": [-1,2.2,-1], "max": [1,2.3,1], "material": { "type": "dielectric", "ior": { "pairs": [[300, 1.8], [900, 1.5]] } } })"}),
     {"bidirectional", "path", "bidirectional-power"}},
    {"shading normals on glass",
     shapes({floor_quad, back_wall, quad_lamp(0.5, 6), facets}),
     {"bidirectional", "path", "bidirectional-power"}}};

std::unique_ptr<Scene> scene_of(SceneTrial const& trial) {
    if (trial.text.empty()) {
        auto scene = load_scene(find_scene(trial.scene));
        scene->film.width = scene->film.height = 12;
        return scene;
    }
    TemporaryFolder const folder;
    folder.write("ball.obj", faceted_ball);
    return load_scene(folder.write("scene.json", scene_text(view, trial.text)));
}

struct Picture {
    Image<Moments> pixel;  // Y
    Moments mean;
    double seconds = 0;
};

// The mean of independent pictures, whose spread is the error: right for splats and for any sampler.
Picture picture(Scene const& scene, char const* integrator, int pictures, int spp, std::uint64_t seed) {
    Picture p;
    p.pixel = Image<Moments>(scene.film.width, scene.film.height);
    double const n = pictures, pixels = static_cast<double>(p.pixel.pixel.size());
    for (int i = 0; i < pictures; ++i) {
        Film const film =
            rendered(scene, integrator,
                     {.spp = spp, .seed = seed + static_cast<std::uint64_t>(i), .sampler = SamplerKind::independent});
        CHECK(film.rejected() == std::array<std::uint64_t, rejection_count>{});
        double mean = 0;
        for (std::size_t k = 0; k < p.pixel.pixel.size(); ++k) {
            double const y = film.mean(static_cast<int>(k) % film.width(), static_cast<int>(k) / film.width()).Y;
            p.pixel.pixel[k].mean += y / n;
            p.pixel.pixel[k].variance += y * y / n;
            mean += y / pixels;
        }
        p.mean.mean += mean / n;
        p.mean.variance += mean * mean / n;
    }
    auto const finish = [&](Moments& m) { m.variance = std::max(0.0, m.variance - m.mean * m.mean) / (n - 1); };
    finish(p.mean);
    for (Moments& m : p.pixel.pixel) finish(m);
    return p;
}

double error_of(Moments const& m) { return std::sqrt(m.variance) / m.mean; }

void check_agreement(SceneTrial const& trial, int pictures, int spp, double margin, double error) {
    auto const scene = scene_of(trial);
    Picture const oracle = picture(*scene, trial.integrators.front(), pictures, spp, 1);
    for (std::size_t i = 1; i < trial.integrators.size(); ++i) {
        Picture const found = picture(*scene, trial.integrators[i], pictures, spp, 1000 * (i + 1));
        int beyond = 0;
        for (std::size_t k = 0; k < found.pixel.pixel.size(); ++k) {
            Moments const &a = found.pixel.pixel[k], &b = oracle.pixel.pixel[k];
            beyond += square(a.mean - b.mean) > square(3.4) * (a.variance + b.variance) + 1e-20;
        }
        double const ratio = found.mean.mean / oracle.mean.mean - 1;
        std::string const result =
            fmt::format("{}: {} is {:+.3f} % of {}; errors {:.3f} % and {:.3f} %, {} pixels beyond", trial.scene,
                        trial.integrators[i], 100 * ratio, trial.integrators.front(), 100 * error_of(found.mean),
                        100 * error_of(oracle.mean), beyond);
        INFO(result);
        WARN(result);
        CHECK(std::abs(ratio) < margin);
        CHECK(std::hypot(error_of(found.mean), error_of(oracle.mean)) < error);
        CHECK(beyond <= 2);
    }
}

}  // namespace

TEST_CASE("unbiased integrators agree on six scenes", "[.long]") {
    for (SceneTrial const& trial : trials) check_agreement(trial, 64, 64, 0.01, 0.1);
}
