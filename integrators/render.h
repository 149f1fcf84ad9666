// SPDX-License-Identifier: Apache-2.0
// The render loop: tiles over threads, samples in passes, paths in batches. A pixel is summed by one thread at a time
// in the order of its samples, so the picture does not depend on threads, tile order or passes. A pixel goes on from
// the samples that the film has of it: a film that was saved at any time is gone on with to the same bits.
#pragma once

#include <atomic>
#include <functional>
#include <limits>
#include <optional>

#include "film/error_target.h"
#include "integrators/integrator.h"
#include "integrators/light_groups.h"
#include "integrators/plan.h"

namespace iride {

struct RenderSettings {
    int spp = 64;                                 // the most samples per pixel
    std::optional<double> seconds = {};           // stop at the end of a pass after this time
    std::optional<ErrorTarget> stop_at = {};      // stop at the end of a pass when this is reached
    Image<std::uint32_t> const* goals = nullptr;  // samples of each pixel, instead of spp; of the film's size
    std::uint64_t seed = 0;
    std::uint32_t first_sample = 0;  // number of each pixel's first sample: shares of a picture in several processes
    SamplerKind sampler = SamplerKind::sobol;
    int threads = 0;                                 // 0: all
    bool reversed_tiles = false;                     // another tile order, for the test that it does not matter
    std::atomic<bool> const* interrupted = nullptr;  // stop soon, keep what is there
    std::function<void(int done_spp, double share)> on_progress = {};  // share of the whole work, 0 .. 1
    std::function<void()> on_pass = {};  // after each pass: the film is consistent then, and may be saved
    double pass_seconds = std::numeric_limits<double>::infinity();  // passes are meant to be no longer than this
    LightGroupFilms* groups = nullptr;  // filled beside the film, if the integrator tells lights apart
};

struct RenderReport {
    int spp = 0;  // samples per pixel of the finished passes
    double seconds = 0;
    std::uint64_t paths = 0;
    RayStatistics rays;
    double embree_share = 0;  // of the sampling loop's time, from some of the batches
    bool interrupted = false;
};

// The film a scene asks for, of the whole picture or of a part of it.
Film make_film(Scene const& scene, std::optional<Crop> const& crop = {});

RenderReport render(Scene const& scene, RenderPlan const& plan, Integrator& integrator, RenderSettings const& settings,
                    Film& film);

}  // namespace iride
