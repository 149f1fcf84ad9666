// SPDX-License-Identifier: Apache-2.0
#include "bench/measure/rays.h"

#include "bench/measure/clock.h"

namespace iride::bench {

namespace {

// The rays of a render, in the order in which one thread asks for them.
std::vector<RecordedRay> record(Scene const& scene, Integrator& integrator, RenderPlan const& plan, int spp) {
    std::vector<RecordedRay> rays;
    RayStatistics statistics, unrecorded;
    integrator.prepare(scene, {0, 0, static_cast<std::uint32_t>(spp)}, unrecorded);
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

}  // namespace

RayRace::RayRace(Scene const& scene, std::string const& integrator, int spp)
    : scene_(scene),
      plan_(make_plan(scene)),
      integrator_(make_integrator(integrator, scene, plan_)),
      spp_(spp),
      rays_(record(scene, *integrator_, plan_, spp)) {}

RayRates RayRace::round() const {
    Film film = make_film(scene_);
    RenderReport const report = render(scene_, plan_, *integrator_, {.spp = spp_, .threads = 1}, film);
    Clock::time_point const start = Clock::now();
    check(scene_.accelerator->trace_bare(rays_) <= rays_.size(), "a ray hits once");
    double const bare = static_cast<double>(rays_.size()) / seconds_since(start);
    return {static_cast<double>(report.rays.rays()) / report.seconds, bare,
            static_cast<double>(report.paths) / report.seconds};
}

}  // namespace iride::bench
