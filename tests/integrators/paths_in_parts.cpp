// SPDX-License-Identifier: Apache-2.0
// Camera paths split into parts bring the light that whole ones bring, and are split where that saves time.
#include "integrators/splits.h"

#include <atomic>

#include "support/agreement.h"

using namespace iride;
using namespace iride::test;

namespace {

std::string const gold = R"({ "type": "conductor", "ior": "Au", "roughness": 0.1 })",
                  glass = R"({ "type": "dielectric", "ior": { "pairs": [[300, 1.7], [900, 1.4]] } })",
                  fog = R"({ "type": "dielectric", "ior": 1, "scattering_per_m": 1.5 })";

std::shared_ptr<Scene> lit(std::string const& body, std::string const& film = "") {
    auto const text = scene_text(view, R"("shapes": [)" + floor_quad + "," + lamp + "," + sphere(body) + "]", film);
    return std::shared_ptr<Scene>(scene_from(text));
}

void check_parts(std::string const& body, char const* integrator, std::string const& film = "") {
    check_agreement(*lit(body, film), {.integrator = integrator, .oracle = "path", .spp = 1000, .oracle_spp = 4000});
}

// A picture whose paths bring 1 give or take what noise(x) draws from numbers of their first vertex.
template <class Noise>
LearntSplits learnt_of(int width, int height, int most, Noise&& noise, LightPathsBeside const& beside = {},
                       std::uint32_t sample = 16) {
    auto const scene = scene_from(scene_text(view, R"("shapes": [)" + floor_quad + "," + lamp + "]"));
    scene->film.width = width;
    scene->film.height = height;
    RayStatistics all;
    auto const follow = [&](std::span<CameraPath> paths, RayStatistics& rays) {
        for (CameraPath& path : paths) {
            path.sampler.begin_vertex(0);
            path.radiance = Radiance(1 + noise(path, path.sampler.next() - 0.5f));
            ++rays.closest_rays;
        }
    };
    return SplitPilot(make_plan(*scene), most).learn(*scene, sample, follow, beside, all);
}
template <class Noise>
Splits learnt(int width, int height, int most, Noise&& noise) {
    return learnt_of(width, height, most, noise).splits;
}

}  // namespace

// Fails if a part counts as a whole path, or if the light paths' weights know nothing of the parts.
TEST_CASE("parts bring what whole paths bring: a caustic, glass, fog", "[law]") {
    check_parts(gold, "path:splits=8");
    check_parts(glass, "path:splits=8");
    check_parts(fog, "path:splits=8");
    check_parts(gold, "caustic-path:splits=8,light_paths=0.3");
    check_parts(glass, "caustic-path:splits=4");
    check_parts(gold, "caustic-path:splits=8", R"(, "filter": "gaussian")");
}

// Fails if parts go where paths differ by their place alone, or if noise that is twice as high has twice as many.
TEST_CASE("paths are split by the noise of what follows their first vertex", "[law]") {
    auto const by_half = learnt(64, 32, 16, [](CameraPath const& path, float u) {
        return path.x < 16 ? 1.6f * u : path.x < 32 ? 0.2f * u : 0.0f;
    });
    REQUIRE_FALSE(by_half.none());
    std::uint32_t const noisy = by_half.at(4, 16), quiet = by_half.at(24, 16);
    CHECK(noisy == 16);
    CHECK((quiet == 1 || quiet == 2));
    CHECK(by_half.at(60, 16) == 1);
    CHECK(by_half.at(-3, 40) == noisy);  // a filter may reach beyond the edge
    CHECK(learnt(64, 32, 16, [](CameraPath const& path, float) { return 0.5f * std::sin(path.x); }).none());
    CHECK(learnt(64, 32, 16, [](CameraPath const&, float) { return 0.0f; }).none());
    CHECK(learnt(64, 32, 1, [](CameraPath const&, float u) { return u; }).none());
}

namespace {

// Camera paths with a noise, and beside them light paths that bring `light` to every pixel, each to one, for `rays`.
float share_beside(double light, int rays, float share_in_pilot) {
    double const pixels = 64.0 * 64.0;
    auto const follow = [&](std::span<CameraPath> paths, Splits const&, RayStatistics& done) {
        for (CameraPath& path : paths) {
            path.sampler.begin_vertex(1);
            if (path.sampler.next() >= share_in_pilot) continue;
            Sample2 const at = path.sampler.next2();
            path.splats.push_back({64 * at.x, 64 * at.y,
                                   Radiance(static_cast<float>(light * pixels / static_cast<double>(share_in_pilot)))});
            done.closest_rays += static_cast<std::uint64_t>(rays);
        }
    };
    auto const noise = [](CameraPath const&, float u) { return u; };
    return learnt_of(64, 64, 1, noise, {follow, share_in_pilot}).light_paths.value();
}

}  // namespace

// s = sqrt(u T / (c E)). Fails if the share that the pilot looks at counts, or if noise or cost go in otherwise.
TEST_CASE("light paths are as many as their noise and cost make best", "[law]") {
    float const one = share_beside(0.15, 2, 0.5f);
    // Two numbers of one path are in two halves of [0, 1): E = <(a - b)^2> / 2 = 7/48, T = 1 ray, c = 1.5 x 2 rays.
    double const u = square(0.15) / (square(1.15) + 0.01), E = 7.0 / 48 / 1.01;
    REQUIRE(one == Approx(std::sqrt(u / (1.5 * 2 * E))).epsilon(0.03));
    CHECK(share_beside(0.15, 2, 0.25f) == Approx(one).epsilon(0.03));
    CHECK(share_beside(0.15, 8, 0.5f) == Approx(one / 2).epsilon(0.03));
    // Relative to (1 + light)^2 + .01.
    CHECK(share_beside(0.3, 2, 0.5f) == Approx(2 * one * (1.15 / 1.3)).epsilon(0.03));
    CHECK(share_beside(1e-3, 2, 0.5f) == Approx(0.1));
    CHECK(share_beside(10, 1, 0.5f) == Approx(1));
}

// Fails if the first samples wait for a pilot that costs more than they do, or if two passes would split one otherwise.
TEST_CASE("the more samples, the more a pilot asks", "[law]") {
    auto const scene = lit(gold);
    scene->film.width = scene->film.height = 64;
    SplitPilot pilot(make_plan(*scene), 8);
    CHECK(pilot.samples_alike(0) == 1);
    CHECK(pilot.samples_alike(1) == 3);
    CHECK(pilot.samples_alike(3) == 1);
    CHECK(pilot.samples_alike(4) == 12);
    CHECK(pilot.samples_alike(16) > 1 << 20);
    int const pixels = scene->film.width * scene->film.height;
    for (std::uint32_t first : {0u, 1u, 4u, 16u}) {
        std::atomic<int> paths = 0;
        RayStatistics rays;
        CHECK(pilot.is_due(first));
        auto const follow = [&](std::span<CameraPath> some, RayStatistics&) { paths += static_cast<int>(some.size()); };
        bool const split = !pilot.learn(*scene, first, follow, {}, rays).splits.none();
        CHECK((first > 0 || (!split && paths == 0)));
        CHECK_FALSE(pilot.is_due(first));
        CHECK(paths <= pixels * std::max(1, static_cast<int>(first)) / 8);
    }
}

// Of k parts the k-th part of the noise is left in .15 + .85 k of the time: at best 1.18 times as good if all pixels
// are alike, twice where half of them are still. Fails if early samples take what the later ones do.
TEST_CASE("early samples are split only where much is to be had", "[law]") {
    auto const split = [](std::uint32_t sample, float noisy) {
        auto const noise = [=](CameraPath const& path, float u) { return path.x < noisy ? u : 0.0f; };
        return !learnt_of(64, 64, 16, noise, {}, sample).splits.none();
    };
    for (std::uint32_t sample : {1u, 4u}) {
        CHECK_FALSE(split(sample, 64));
        CHECK(split(sample, 32));
    }
    CHECK(split(16, 64));
    CHECK(split(16, 32));
}

// Few samples of many pictures, so that whole ones and those in parts are among them. Fails if splats do not have the
// weights of their samples.
TEST_CASE("whole paths and parts together bring what whole paths bring", "[law]") {
    auto const scene = lit(gold);
    constexpr int pictures = 800, spp = 3;
    Film few = make_film(*scene);
    for (int i = 0; i < pictures; ++i)
        few.add(rendered(*scene, "caustic-path:splits=16",
                         {.spp = spp, .seed = 100u + static_cast<unsigned>(i), .sampler = SamplerKind::independent}));
    check_films_agree(few, rendered(*scene, "path", {.spp = 8000, .seed = 5, .sampler = SamplerKind::independent}));
}

// At least half the variance goes with up to 8 parts. Fails if the parts of a path share their numbers.
TEST_CASE("paths in parts are quieter than whole ones", "[law]") {
    auto const scene = lit(gold);
    scene->film.width = scene->film.height = 64;  // blocks of their own for the ball and the floor
    auto const noise = [&](char const* integrator) {
        return square(rendered(*scene, integrator, {.spp = 32, .seed = 3}).relative_error());
    };
    CHECK(noise("path:splits=8") < 0.5 * noise("path"));
    CHECK(noise("caustic-path:splits=8") < 0.5 * noise("caustic-path"));
}

TEST_CASE("the numbers of a path's parts are those of as many more samples", "[law]") {
    for (SamplerKind kind : {SamplerKind::sobol, SamplerKind::zsobol, SamplerKind::stratified})
        for (std::uint32_t sample : {0u, 5u})
            for (std::uint32_t part : {0u, 3u}) {
                Sampler whole(kind, 7, 11, sample), more(kind, 7, 11, 4 * sample + part);
                whole.split(part, 4);
                for (std::uint32_t vertex : {0u, 2u}) {
                    whole.begin_vertex(vertex);
                    more.begin_vertex(vertex);
                    for (int i = 0; i < 4; ++i) {
                        Sample2 const a = whole.next2(), b = more.next2();
                        CHECK((a.x == b.x && a.y == b.y));
                    }
                }
            }
}
