// SPDX-License-Identifier: Apache-2.0
// How near a render comes to bare ray tracing: see bench/README.md.
#include <embree3/rtcore.h>
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>

#include "integrators/render.h"

namespace {

using namespace iride;
using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

// The rays of a render, in the order in which one thread asks for them.
std::vector<RecordedRay> record(Scene const& scene, Integrator const& integrator, RenderPlan const& plan, int spp) {
    std::vector<RecordedRay> rays;
    RayStatistics statistics;
    statistics.recording = &rays;
    PathStarter const starter(scene, plan, scene.film.width, scene.film.height, scene.render.sampler, 0);
    std::vector<CameraPath> batch;
    auto const follow = [&] {
        integrator.follow(scene, batch, statistics);
        batch.clear();
    };
    for (int y = 0; y < scene.film.height; ++y)
        for (int x = 0; x < scene.film.width; ++x)
            for (int s = 0; s < spp; ++s) {
                starter.start(x, y, static_cast<std::uint32_t>(s), batch.emplace_back());
                if (batch.size() == batch_size) follow();
            }
    follow();
    return rays;
}

std::uint64_t trace_bare(RTCScene scene, std::vector<RecordedRay> const& rays) {
    std::uint64_t hits = 0;
    for (RecordedRay const& recorded : rays) {
        Ray const& r = recorded.ray;
        RTCRayHit rh;
        rh.ray = {r.origin.x(),
                  r.origin.y(),
                  r.origin.z(),
                  r.t_min,
                  r.direction.x(),
                  r.direction.y(),
                  r.direction.z(),
                  0,
                  r.t_max,
                  ~0u,
                  0,
                  0};
        rh.hit.geomID = RTC_INVALID_GEOMETRY_ID;
        rh.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
        RTCIntersectContext context;
        rtcInitIntersectContext(&context);
        if (recorded.shadow) {
            rtcOccluded1(scene, &context, &rh.ray);
            hits += rh.ray.tfar < 0;
        } else {
            rtcIntersect1(scene, &context, &rh);
            hits += rh.hit.geomID != RTC_INVALID_GEOMETRY_ID;
        }
    }
    return hits;
}

int run(std::string const& name, int spp, int rounds) {
    auto const scene = load_scene(find_scene(name));
    RenderPlan const plan = make_plan(*scene);
    auto const integrator = make_integrator("path", *scene, plan);
    std::vector<RecordedRay> const rays = record(*scene, *integrator, plan, spp);
    std::vector<double> ratios;
    for (int round = 0; round < rounds; ++round) {
        Film film = make_film(*scene);
        RenderReport const report = render(*scene, plan, *integrator, {.spp = spp, .threads = 1}, film);
        double const rendered =
            static_cast<double>(report.rays.closest_rays + report.rays.shadow_rays) / report.seconds;
        auto const start = Clock::now();
        std::uint64_t const hits = trace_bare(static_cast<RTCScene>(scene->accelerator->embree_scene()), rays);
        double const bare = static_cast<double>(rays.size()) / seconds_since(start);
        ratios.push_back(rendered / bare);
        fmt::print("render {:.3g} rays/s, {:.3g} paths/s; bare Embree {:.3g} rays/s ({} of {} hit); ratio {:.3f}\n",
                   rendered, static_cast<double>(report.paths) / report.seconds, bare, hits, rays.size(),
                   ratios.back());
    }
    std::ranges::sort(ratios);
    fmt::print("median ratio {:.3f}\n", ratios[ratios.size() / 2]);
    return 0;
}

}  // namespace

int main(int argc, char** argv) {
    if (argc < 2) {
        fmt::print(stderr, "usage: ray_throughput SCENE [SPP] [ROUNDS]\n");
        return 2;
    }
    try {
        return run(argv[1], argc > 2 ? std::max(1, std::atoi(argv[2])) : 16,
                   argc > 3 ? std::max(1, std::atoi(argv[3])) : 5);
    } catch (InputError const& e) {
        fmt::print(stderr, "{}\n", e.what());
        return 2;
    }
}
