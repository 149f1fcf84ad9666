// SPDX-License-Identifier: Apache-2.0
// A trial tells by few paths which of two integrators is the quieter, and `auto` goes over to it.
#include "integrators/trial.h"

#include <fmt/format.h>

#include <atomic>

#include "support/agreement.h"
#include "support/same_bits.h"

using namespace iride;
using namespace iride::test;

namespace {

// A grey room of 2 m, open in front. The lamp hangs 10 cm below the ceiling and shines down, or up at the ceiling.
std::unique_ptr<Scene> room(bool up, int side) {
    auto const quad = [](char const* corners, char const* more) {
        return fmt::format(R"({{ "type": "quad", "corners": {}, {} }})", corners, more);
    };
    char const* const grey = R"("material": { "type": "diffuse", "reflectance": 0.6 })";
    char const* const shining = R"("material": { "type": "black" }, "emission": { "radiance": 5 })";
    auto scene = scene_from(scene_text(
        R"({ "eye": [0, 1, -3.2], "target": [0, 1, 0], "field_deg": 44 })",
        fmt::format(
            R"("shapes": [{}, {}, {}, {}, {}, {}])", quad("[[-1,0,-1],[-1,0,1],[1,0,1],[1,0,-1]]", grey),
            quad("[[-1,2,-1],[1,2,-1],[1,2,1],[-1,2,1]]", grey), quad("[[-1,0,1],[-1,2,1],[1,2,1],[1,0,1]]", grey),
            quad("[[-1,0,-1],[-1,2,-1],[-1,2,1],[-1,0,1]]", grey), quad("[[1,0,1],[1,2,1],[1,2,-1],[1,0,-1]]", grey),
            quad(up ? "[[-0.2,1.9,-0.2],[-0.2,1.9,0.2],[0.2,1.9,0.2],[0.2,1.9,-0.2]]"
                    : "[[-0.2,1.9,-0.2],[0.2,1.9,-0.2],[0.2,1.9,0.2],[-0.2,1.9,0.2]]",
                 shining))));
    scene->film.width = scene->film.height = side;
    return scene;
}

struct Measured {
    double variance, rays;  // of a sample
};
// Of a picture's pixels over the square of their mean, by pairs of pictures of few samples.
Measured measured(Scene const& scene, char const* integrator, Film const& mean) {
    constexpr int pairs = 12, spp = 8;
    RenderPlan const plan = make_plan(scene);
    Measured m{0, 0};
    for (int i = 0; i < pairs; ++i) {
        std::array<Film, 2> two{make_film(scene), make_film(scene)};
        for (std::size_t k : {0u, 1u}) {
            RenderSettings const settings{.spp = spp, .seed = 2u * static_cast<unsigned>(i) + k};
            auto const report = render(scene, plan, *make_integrator(integrator, scene, plan), settings, two[k]);
            m.rays += static_cast<double>(report.rays.rays()) / static_cast<double>(report.paths) / (2 * pairs);
        }
        for (int y = 0; y < mean.height(); ++y)
            for (int x = 0; x < mean.width(); ++x)
                m.variance +=
                    square(two[0].mean(x, y).Y - two[1].mean(x, y).Y) / (square(mean.mean(x, y).Y) + relmse_floor);
    }
    m.variance *= spp / (2.0 * pairs * mean.width() * mean.height());
    return m;
}

bool brings_splats(Scene const& scene, std::uint32_t first_sample) {
    RenderPlan const plan = make_plan(scene);
    auto const integrator = make_integrator("auto:share=false", scene, plan);
    RayStatistics rays;
    integrator->prepare(scene, {0, first_sample, first_sample + 1}, rays);
    PathStarter const starter(scene, plan, scene.film.width, scene.film.height, SamplerKind::sobol, 1);
    std::vector<CameraPath> paths(static_cast<std::size_t>(scene.film.width));
    int x = 0;
    for (CameraPath& path : paths) starter.start(x++, scene.film.height / 2, first_sample, path);
    integrator->follow(scene, paths, rays);
    return std::ranges::any_of(paths, [](CameraPath const& p) { return !p.splats.empty(); });
}

}  // namespace

// Fails if the noise of splats is left out, or counted for the whole picture.
TEST_CASE("a trial finds how the variances and rays of two integrators compare", "[law]") {
    for (bool up : {false, true}) {
        auto const scene = room(up, 32);
        RenderPlan const plan = make_plan(*scene);
        auto const first = make_integrator("path", *scene, plan),
                   second = make_integrator("bidirectional-power", *scene, plan);
        RayStatistics rays;
        PilotStarter const starter(*scene, plan, PilotStarter::Pairs::paths);
        TrialResult const found = try_out(*scene, PilotBlocks(*scene, 2), starter, 8, *first, *second, rays);
        Film const mean = rendered(*scene, "bidirectional-power", {.spp = 1000, .seed = 77});
        Measured const a = measured(*scene, "path", mean), b = measured(*scene, "bidirectional-power", mean);
        INFO((up ? "up: " : "down: ") << found.variance << " for " << a.variance / b.variance);
        CHECK(std::abs(std::log(found.variance / (a.variance / b.variance))) < std::log(1.3));
        CHECK(found.rays_error / found.variance == Approx(a.rays / b.rays).epsilon(0.03));
    }
}

// Paths that bring their first vertex's first number: of 8 samples of one sequence the mean's variance is an eighth of
// that of independent ones, or less. Fails if the two of a pair are of one sequence, or parts of one path.
TEST_CASE("a trial's noise is that of stratified samples", "[law]") {
    auto const scene = room(false, 32);
    RenderPlan const plan = make_plan(*scene);
    PilotStarter const starter(*scene, plan, PilotStarter::Pairs::paths);
    auto const follow = [](std::span<CameraPath> paths, RayStatistics&) {
        for (CameraPath& path : paths) {
            path.sampler.begin_vertex(0);
            path.radiance = Radiance(path.sampler.next());
        }
    };
    RayStatistics rays;
    Eigen::Array3d independent(0, 0, 0), stratified = independent;
    for (BlockNoise const& n : noise_of(*scene, PilotBlocks(*scene, 2), 8, starter, false, follow, rays).pixel)
        independent += n.apart, stratified += n.of_mean;
    CHECK(stratified[1] < independent[1] / 8);
    CHECK(stratified[1] > independent[1] / 1000);
}

// Fails if the trial is not asked, or if the first samples wait for it.
TEST_CASE("auto joins paths where light comes by way of a ceiling, and not where it comes from a lamp", "[law]") {
    CHECK(brings_splats(*room(true, 32), 16));
    CHECK_FALSE(brings_splats(*room(true, 32), 15));
    CHECK_FALSE(brings_splats(*room(false, 32), 16));
}

// Few samples of either integrator in each of many pictures. Fails if the samples that bring no splats are not counted
// among those that do.
TEST_CASE("samples before and after the trial bring the same light together", "[law]") {
    auto const scene = room(true, 32);
    REQUIRE(brings_splats(*scene, 16));
    constexpr int pictures = 100, spp = 22;
    Film few = make_film(*scene);
    for (int i = 0; i < pictures; ++i)
        few.add(rendered(*scene, "auto:share=false",
                         {.spp = spp, .seed = 100u + static_cast<unsigned>(i), .sampler = SamplerKind::independent}));
    Film const many = rendered(*scene, "path", {.spp = 8000, .seed = 5, .sampler = SamplerKind::independent});
    auto const a = picture_mean(few), b = picture_mean(many);
    for (std::size_t k = 0; k < 3; ++k) {
        double const error = std::sqrt(a[k].variance + b[k].variance);
        INFO(a[k].mean << " against " << b[k].mean << ", give or take " << error);
        CHECK(std::abs(a[k].mean - b[k].mean) < 4 * error);
        CHECK(error < 0.005 * b[k].mean);
    }
}

// Fails if the samples of a part, or of a crop, that no light paths go with take a share of those of another.
TEST_CASE("parts before and after the trial, and a crop without it, add up to one picture", "[law]") {
    auto const scene = room(true, 32);
    RenderPlan const plan = make_plan(*scene);
    auto const part = [&](int spp, std::uint32_t first, std::optional<Crop> const& crop = {}) {
        RenderPlan without = plan;
        if (crop) without.no_light_paths = "a crop has no light paths of its own";
        Film film = make_film(*scene, crop);
        render(*scene, without, *make_integrator("auto:share=false", *scene, without),
               {.spp = spp, .first_sample = first}, film);
        return film;
    };
    Film const whole = part(20, 0), early = part(16, 0), late = part(4, 16), crop = part(24, 100, Crop{4, 4, 20, 20});
    REQUIRE(late.splats());
    REQUIRE_FALSE(early.splats());
    REQUIRE_FALSE(crop.splats());
    Film sum = early, turned = late;
    sum.add(late);
    turned.add(early);
    Film with_crop = whole;
    with_crop.add(crop);
    for (int y = 0; y < whole.height(); ++y)
        for (int x = 0; x < whole.width(); ++x) {
            double const expected = whole.mean(x, y).Y;
            CHECK(sum.mean(x, y).Y == Approx(expected));
            CHECK(turned.mean(x, y).Y == Approx(expected));
            bool const inside = x >= 4 && y >= 4 && x < 20 && y < 20;
            double mixed = expected;
            if (inside) {
                double const w = whole.pixel(x, y).weight, v = crop.pixel(x - 4, y - 4).weight;
                mixed = (w * expected + v * crop.mean(x - 4, y - 4).Y) / (w + v);
            }
            CHECK(with_crop.mean(x, y).Y == Approx(mixed));
        }
}

// After 16 samples of all tiles, 48 more of some. Fails if light paths count for all pixels alike: by a tenth.
TEST_CASE("a picture that is interrupted after the trial is as bright in all its tiles", "[law]") {
    auto const scene = room(true, 32);
    RenderPlan const plan = make_plan(*scene);
    Film const many = rendered(*scene, "bidirectional-power", {.spp = 4000, .seed = 5});
    double found = 0, expected = 0;
    bool same = true;
    for (std::uint64_t seed = 0; seed < 20; ++seed) {
        Film film = make_film(*scene);
        std::atomic<bool> stop = false;
        int tiles = 0;
        RenderSettings settings{.spp = 16, .seed = seed, .threads = 1, .interrupted = &stop};
        auto const integrator = make_integrator("auto:share=false", *scene, plan);
        render(*scene, plan, *integrator, settings, film);
        Film const before = film;
        settings.spp = 48 * 16;  // in passes of 48
        settings.on_progress = [&](int, double) { stop = ++tiles == 2; };
        REQUIRE(render(*scene, plan, *integrator, settings, film).interrupted);
        for (int y = 0; y < film.height(); ++y)
            for (int x = 0; x < film.width(); ++x)
                if (film.pixel(x, y).taken() == 16) {
                    same = same && film.mean(x, y).Y == before.mean(x, y).Y;
                } else {
                    found += film.mean(x, y).Y;
                    expected += many.mean(x, y).Y;
                }
    }
    CHECK(same);
    CHECK(found == Approx(expected).epsilon(0.02));
}

TEST_CASE("auto's pictures are the same bits whatever passes and stops surround the trial", "[law]") {
    auto const scene = room(true, 33);
    auto const picture = [&](RenderSettings settings) {
        settings.spp = 20;
        return values_of(rendered(*scene, "auto:share=false", settings));
    };
    auto const one = picture({.threads = 1});
    CHECK((picture({.threads = 2, .reversed_tiles = true}) == one));
    CHECK((picture({.seconds = 1e9}) == one));  // passes that double
    RenderPlan const plan = make_plan(*scene);
    auto const again = make_integrator("auto:share=false", *scene, plan);
    for (int i = 0; i < 2; ++i) {
        Film whole = make_film(*scene);
        render(*scene, plan, *again, {.spp = 20}, whole);
        CHECK((values_of(whole) == one));
    }
    Film film = make_film(*scene);
    for (int spp : {3, 16, 18, 20})
        render(*scene, plan, *make_integrator("auto:share=false", *scene, plan), {.spp = spp}, film);
    CHECK((values_of(film) == one));
    auto const unsplit = [&](int threads, std::optional<double> seconds) {
        return values_of(
            rendered(*scene, "auto:splits=1,share=false", {.spp = 24, .seconds = seconds, .threads = threads}));
    };
    CHECK((unsplit(1, {}) == unsplit(2, 1e9)));
}
