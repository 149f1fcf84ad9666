// SPDX-License-Identifier: Apache-2.0
#include "integrators/render.h"

#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <chrono>
#include <cmath>

#include "film/filter.h"

namespace iride {

namespace {

constexpr int tile_size = 16;             // pixels: small enough to balance, large enough to keep the caches warm
constexpr std::uint32_t timed_path = 64;  // every 64th path of a pixel tells the time spent in Embree

using Clock = std::chrono::steady_clock;
double seconds_since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

struct ThreadStatistics {
    RayStatistics rays;
    std::uint64_t timed_ticks = 0;  // of whole timed paths
};

class Loop {
  public:
    Loop(Scene const& scene, RenderPlan const& plan, Integrator const& integrator, RenderSettings const& settings,
         Film& film)
        : scene_(scene),
          integrator_(integrator),
          settings_(settings),
          film_(film),
          camera_(scene.camera, film.width(), film.height()),
          wavelengths_(make_wavelength_sampler(scene, plan)),
          columns_((film.width() + tile_size - 1) / tile_size),
          rows_((film.height() + tile_size - 1) / tile_size) {}

    int tile_count() const { return columns_ * rows_; }
    bool stopped() const { return settings_.interrupted && settings_.interrupted->load(std::memory_order_relaxed); }

    // Samples [first, last) of every pixel of a tile.
    void render_tile(int tile, std::uint32_t first, std::uint32_t last) {
        ThreadStatistics& statistics = statistics_.local();
        int const x0 = tile % columns_ * tile_size, y0 = tile / columns_ * tile_size;
        for (int y = y0; y < std::min(y0 + tile_size, film_.height()); ++y)
            for (int x = x0; x < std::min(x0 + tile_size, film_.width()); ++x)
                for (std::uint32_t s = first; s < last; ++s) render_sample(x, y, s, statistics);
    }

    ThreadStatistics totals() const {
        ThreadStatistics total;
        for (ThreadStatistics const& s : statistics_) {
            total.rays.add(s.rays);
            total.timed_ticks += s.timed_ticks;
        }
        return total;
    }

  private:
    void render_sample(int x, int y, std::uint32_t index, ThreadStatistics& statistics) {
        statistics.rays.timed = index % timed_path == timed_path / 2;
        std::uint64_t const start = statistics.rays.timed ? processor_ticks() : 0;
        Sampler sampler(settings_.sampler, settings_.seed, static_cast<std::uint32_t>(y * film_.width() + x), index);
        Sample2 const place = filtered(sampler.next2());
        Wavelengths const wavelengths = wavelengths_.sample(sampler.next());
        Ray const ray = camera_.ray(static_cast<float>(x) + 0.5f + place.x, static_cast<float>(y) + 0.5f + place.y,
                                    sampler.next2());
        PathResult const path = integrator_.radiance(scene_, ray, wavelengths, sampler, statistics.rays);
        if (!path.complete)
            film_.reject(x, y, Rejection::path_too_long);
        else if (!is_finite(path.radiance))
            film_.reject(x, y, Rejection::not_finite);
        else if (is_negative(path.radiance))
            film_.reject(x, y, Rejection::negative);
        else
            film_.add(x, y, wavelengths, path.radiance);
        if (statistics.rays.timed) statistics.timed_ticks += processor_ticks() - start;
    }

    Sample2 filtered(Sample2 u) const {
        float const r = scene_.film.filter_radius;
        switch (scene_.film.filter) {
            case FilterKind::triangle:
                return {sample_triangle(u.x, r), sample_triangle(u.y, r)};
            case FilterKind::gaussian:
                return sample_gaussian(u, r);
            case FilterKind::box:
                break;
        }
        return {sample_box(u.x, r), sample_box(u.y, r)};
    }

    Scene const& scene_;
    Integrator const& integrator_;
    RenderSettings const& settings_;
    Film& film_;
    Camera camera_;
    WavelengthSampler wavelengths_;
    int columns_, rows_;
    tbb::enumerable_thread_specific<ThreadStatistics> statistics_;
};

// Passes double, so that a time or an error is met closely and the overhead stays small; without either, and with
// progress shown, sixteenths of the whole.
int next_pass(RenderSettings const& s, int done) {
    bool const open_ended = s.seconds || s.relative_error;
    int const wanted = open_ended ? std::max(1, done) : std::max(4, s.spp / 16);
    return std::min(s.spp - done, wanted);
}

}  // namespace

Film make_film(Scene const& scene) {
    FilmSettings const& f = scene.film;
    std::optional<Bands> bands;
    if (f.band_count > 0) bands = Bands{f.band_range, f.band_count};
    return Film(f.width, f.height, cie1931_2deg(), scene.grid, bands);
}

WavelengthSampler make_wavelength_sampler(Scene const& scene, RenderPlan const& plan) {
    SpectralFunction const visible = visible_importance();
    if (!plan.bands) return WavelengthSampler(plan.wavelengths, visible, scene.grid);
    WavelengthRange const bands = scene.film.band_range;
    double const total = visible.integral(plan.wavelengths);
    TabulatedShape mixed;
    for (double nm = plan.wavelengths.min_nm; nm < plan.wavelengths.max_nm + 1; ++nm) {
        bool const in_bands = nm >= bands.min_nm && nm <= bands.max_nm;
        mixed.nm.push_back(nm);
        mixed.value.push_back((total > 0 ? visible.at(nm) / total : 0) + (in_bands ? 1 / bands.width() : 0));
    }
    return WavelengthSampler(plan.wavelengths, SpectralFunction(std::move(mixed), Outside::hold), scene.grid);
}

RenderReport render(Scene const& scene, RenderPlan const& plan, Integrator const& integrator,
                    RenderSettings const& settings, Film& film) {
    Loop loop(scene, plan, integrator, settings, film);
    RenderReport report;
    Clock::time_point const start = Clock::now();
    tbb::task_arena arena(settings.threads > 0 ? settings.threads : tbb::task_arena::automatic);
    std::atomic<std::uint64_t> tiles_done{0};
    auto const share = [&] {
        double const in_pass = static_cast<double>(tiles_done) / loop.tile_count();
        if (settings.seconds) return std::min(1.0, seconds_since(start) / *settings.seconds);
        return std::min(1.0, in_pass / settings.spp);
    };
    while (report.spp < settings.spp && !loop.stopped()) {
        int const pass = next_pass(settings, report.spp);
        arena.execute([&] {
            tbb::parallel_for(0, loop.tile_count(), [&](int i) {
                if (loop.stopped()) return;
                int const tile = settings.reversed_tiles ? loop.tile_count() - 1 - i : i;
                loop.render_tile(tile, static_cast<std::uint32_t>(report.spp),
                                 static_cast<std::uint32_t>(report.spp + pass));
                tiles_done += static_cast<std::uint64_t>(pass);
                if (settings.on_progress) settings.on_progress(report.spp, share());
            });
        });
        if (loop.stopped()) break;
        report.spp += pass;
        if (settings.seconds && seconds_since(start) >= *settings.seconds) break;
        if (settings.relative_error && report.spp >= 2 && film.relative_error() <= *settings.relative_error) break;
    }
    ThreadStatistics const totals = loop.totals();
    report.interrupted = loop.stopped();
    report.seconds = seconds_since(start);
    for (int y = 0; y < film.height(); ++y)
        for (int x = 0; x < film.width(); ++x) report.paths += film.sample_count(x, y);
    report.rays = totals.rays;
    if (totals.timed_ticks > 0)
        report.embree_share = static_cast<double>(totals.rays.traced_ticks) / static_cast<double>(totals.timed_ticks);
    return report;
}

}  // namespace iride
