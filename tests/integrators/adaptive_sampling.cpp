// SPDX-License-Identifier: Apache-2.0
// Adaptive sampling: the mean is that of uniform sampling, the error is what is claimed, nothing small is missed.
#include "integrators/adaptive.h"

#include <fmt/format.h>

#include <catch2/catch.hpp>
#include <cmath>

#include "colour/difference.h"
#include "film/checkpoint.h"
#include "support/agreement.h"

using namespace iride;

namespace {

struct Adaptive {
    int spp = 1 << 20;
    SamplerKind sampler = SamplerKind::sobol;
    std::optional<Crop> crop = {};
    int threads = 0;
};

// Path tracing of a scene, made ready once for any number of pictures.
struct Ready {
    Scene const& scene;
    RenderPlan plan = make_plan(scene);
    std::unique_ptr<Integrator> path = make_integrator("path", scene, plan);

    Film adaptive(std::optional<ErrorTarget> const& target, std::uint64_t seed, Adaptive const& how) const {
        AdaptiveState state = make_adaptive_state(scene, how.crop);
        RenderSettings const settings{.spp = how.spp, .seed = seed, .sampler = how.sampler, .threads = how.threads};
        render_adaptively(scene, plan, *path, settings, target, state.films, state.round);
        return picture_of(state.films);
    }
};
Film adaptive(Scene const& scene, std::optional<ErrorTarget> const& target, std::uint64_t seed,
              Adaptive const& how = {}) {
    return Ready{scene}.adaptive(target, seed, how);
}

std::unique_ptr<Scene> small(char const* name, int width, int height) {
    auto scene = load_scene(find_scene(name));
    scene->film.width = width;
    scene->film.height = height;
    return scene;
}

// A dark floor and, far right, a square lamp in the middle of pixel (13, 5), so many pixels wide.
std::unique_ptr<Scene> spark(double width) {
    double const x0 = 5.5 - width / 2, x1 = 5.5 + width / 2, y0 = 2.5 - width / 2, y1 = 2.5 + width / 2;
    std::string const lamp = fmt::format("[[{0},{2},0.1],[{1},{2},0.1],[{1},{3},0.1],[{0},{3},0.1]]", x0, x1, y0, y1);
    return test::scene_from(R"({
  "camera": { "type": "orthographic", "eye": [0,0,10], "target": [0,0,0], "window": 8 },
  "film": { "size": [16, 16] },
  "materials": { "dark": { "type": "diffuse", "reflectance": 0.05 } },
  "shapes": [
    { "type": "quad", "corners": [[-9,-9,0],[9,-9,0],[9,9,0],[-9,9,0]], "material": "dark" },
    { "type": "quad", "corners": )" +
                            lamp + R"(, "material": "dark", "emission": { "radiance": 100 } } ],
  "lights": [{ "type": "environment", "radiance": 0.01 }] })");
}

}  // namespace

// z of the mean over all pixels and seeds, at a lamp that most floors miss, after as many rounds whatever they found.
// Fails when half A is given samples by its own floor, and when the halves count by their numbers of samples (bright
// samples that are rare then count for less).
TEST_CASE("the mean of adaptive pictures is that of uniform ones", "[law]") {
    auto const scene = spark(0.1);
    Ready const ready{*scene};
    Crop const around{12, 4, 16, 8};
    test::Replicated const found = test::replicated(1500, [&](int seed) {
        Film const film =
            ready.adaptive({}, static_cast<std::uint64_t>(seed), {.spp = 64, .crop = around, .threads = 1});
        return test::picture_mean(film)[1].mean;
    });
    Film uniform = make_film(*scene, around);
    render(*scene, ready.plan, *ready.path, {.spp = 1 << 18, .seed = 9999}, uniform);
    auto const expected = test::picture_mean(uniform)[1];
    double const error = std::hypot(found.error, std::sqrt(expected.variance));
    INFO(found.mean << " against " << expected.mean << ", error " << error);
    CHECK(std::abs(found.mean - expected.mean) < 3.5 * error);
    CHECK(error < 0.03 * expected.mean);
}

TEST_CASE("a lamp of half a pixel in the dark gets the most samples and its true mean", "[law]") {
    auto const scene = spark(0.5);
    for (std::uint64_t seed = 0; seed < 8; ++seed) {
        Film const film = adaptive(*scene, ErrorTarget::relative(0.01), seed);
        Xyz const mean = film.mean(13, 5), variance = film.variance(13, 5);
        std::uint32_t most = 0;
        for (FilmPixel const& p : film.pixels()) most = std::max(most, p.count);
        CHECK(film.sample_count(13, 5) == most);
        CHECK(film.sample_count(0, 0) < most / 4);
        CHECK(std::abs(mean.Y - 25) < 4 * std::sqrt(variance.Y) + .01);  // a quarter of the pixel at 100
    }
}

TEST_CASE("the error reached is the error claimed", "[law]") {
    auto const scene = small("cornell", 32, 32);
    Film const reference = test::rendered(*scene, "path", {.spp = 4096, .seed = 77});
    ErrorTarget const target = ErrorTarget::relative(0.05);
    // Independent samples: those of Sobol' have less error than the spread of samples claims. Fails when the floor's
    // samples are taken again for more.
    Film const film = adaptive(*scene, target, 5, {.sampler = SamplerKind::independent});
    double total = 0;
    for (int y = 0; y < 32; ++y)
        for (int x = 0; x < 32; ++x) {
            Xyz const a = film.mean(x, y), b = reference.mean(x, y);
            for (double Xyz::*c : {&Xyz::X, &Xyz::Y, &Xyz::Z}) total += square(a.*c - b.*c) / (square(b.*c) + .01);
        }
    double const error = std::sqrt(total / (3 * 32 * 32));
    INFO("claimed " << target.error(film) << ", is " << error);
    CHECK(target.error(film) <= 0.05);
    CHECK(error < 0.05 * 1.1);  // 1024 pixels: the root mean square itself is known to 3 %
}

TEST_CASE("99 % of the pixels are within the colour difference claimed", "[law]") {
    auto const scene = small("cornell", 32, 32);
    Film const reference = test::rendered(*scene, "path", {.spp = 8192, .seed = 77});
    ErrorTarget const target = ErrorTarget::parse("de=2");
    Xyz const white = to_xyz(named_white("D65"), 1);
    for (bool by_noise : {true, false}) {
        RenderSettings uniform{.spp = 1 << 16, .seed = 5};
        uniform.stop_at = target;
        Film const film = by_noise ? adaptive(*scene, target, 5) : test::rendered(*scene, "path", uniform);
        int beyond = 0;
        for (int y = 0; y < 32; ++y)
            for (int x = 0; x < 32; ++x)
                beyond += delta_e_2000(to_lab(film.mean(x, y), white), to_lab(reference.mean(x, y), white)) > 2;
        INFO("claimed " << target.error(film) << ", " << beyond << " of 1024 pixels beyond");
        CHECK(target.error(film) <= 2);
        CHECK(beyond <= 22);  // 10.24 expected at most; Poisson's 1e-3
    }
}

TEST_CASE("adaptive pictures have the same bits for any number of threads", "[law]") {
    auto const scene = small("cornell-gold", 20, 17);
    auto const values = [&](int threads) {
        Film const film = adaptive(*scene, ErrorTarget::relative(0.2), 4, {.threads = threads});
        std::vector<double> all;
        for (FilmPixel const& p : film.pixels()) all.insert(all.end(), p.sum.begin(), p.sum.end());
        return all;
    };
    auto const one = values(1);
    CHECK((values(2) == one));
    CHECK((values(3) == one));
}
