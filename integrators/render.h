// SPDX-License-Identifier: Apache-2.0
// The render loop: tiles over threads, samples in passes, paths in batches. A pixel is summed by one thread at a time
// in the order of its samples, so the picture does not depend on threads, tile order or passes.
#pragma once

#include <atomic>
#include <functional>
#include <optional>

#include "film/film.h"
#include "integrators/integrator.h"
#include "integrators/plan.h"

namespace iride {

struct RenderSettings {
    int spp = 64;                               // the most samples per pixel
    std::optional<double> seconds = {};         // stop at the end of a pass after this time
    std::optional<double> relative_error = {};  // stop when Film::relative_error() is at most this
    std::uint64_t seed = 0;
    SamplerKind sampler = SamplerKind::sobol;
    int threads = 0;                                 // 0: all
    bool reversed_tiles = false;                     // another tile order, for the test that it does not matter
    std::atomic<bool> const* interrupted = nullptr;  // stop soon, keep what is there
    std::function<void(int done_spp, double share)> on_progress = {};  // share of the whole work, 0 .. 1
};

struct RenderReport {
    int spp = 0;  // samples per pixel of the finished passes
    double seconds = 0;
    std::uint64_t paths = 0;
    RayStatistics rays;
    double embree_share = 0;  // of the sampling loop's time, from some of the batches
    bool interrupted = false;
};

// The film a scene asks for.
Film make_film(Scene const& scene);

RenderReport render(Scene const& scene, RenderPlan const& plan, Integrator& integrator, RenderSettings const& settings,
                    Film& film);

}  // namespace iride
