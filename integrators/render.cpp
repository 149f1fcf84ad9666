// SPDX-License-Identifier: Apache-2.0
#include "integrators/render.h"

#include <tbb/enumerable_thread_specific.h>
#include <tbb/global_control.h>
#include <tbb/info.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <array>
#include <chrono>

namespace iride {

namespace {

constexpr int tile_size = 16;  // pixels: small enough to balance, large enough to keep the caches warm
constexpr std::uint32_t batches_per_timing =
    32;  // every so many batches of a thread, one tells the time spent in Embree

using Clock = std::chrono::steady_clock;
double seconds_since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

struct ThreadStatistics {
    RayStatistics rays;
    std::uint64_t batches = 0;
    std::uint64_t timed_ticks = 0;  // of whole timed batches
};

// Paths of neighbouring pixels and samples, followed together and added to the film in the order of their start.
class Batch {
  public:
    Batch(Scene const& scene, Integrator const& integrator, PathStarter const& starter, Film& film,
          ThreadStatistics& statistics)
        : scene_(scene), integrator_(integrator), starter_(starter), film_(film), statistics_(statistics) {}

    void start(int x, int y, std::uint32_t sample) {
        if (count_ == 0) begin_timing();
        origin_[count_] = {x, y};
        starter_.start(x, y, sample, paths_[count_++]);
        if (count_ == batch_size) finish();
    }
    void finish() {
        if (count_ == 0) return;
        integrator_.follow(scene_, std::span(paths_).first(count_), statistics_.rays);
        for (std::size_t i = 0; i < count_; ++i) deposit(origin_[i], paths_[i]);
        count_ = 0;
        if (statistics_.rays.timed) statistics_.timed_ticks += processor_ticks() - started_;
    }

  private:
    struct Pixel {
        int x, y;
    };

    void begin_timing() {
        statistics_.rays.timed = statistics_.batches++ % batches_per_timing == batches_per_timing / 2;
        if (statistics_.rays.timed) started_ = processor_ticks();
    }
    void deposit(Pixel p, CameraPath const& path) {
        if (!path.complete)
            film_.reject(p.x, p.y, Rejection::path_too_long);
        else if (!is_finite(path.radiance))
            film_.reject(p.x, p.y, Rejection::not_finite);
        else if (is_negative(path.radiance))
            film_.reject(p.x, p.y, Rejection::negative);
        else
            film_.add(p.x, p.y, path.wavelengths, path.radiance);
    }

    Scene const& scene_;
    Integrator const& integrator_;
    PathStarter const& starter_;
    Film& film_;
    ThreadStatistics& statistics_;
    std::array<CameraPath, batch_size> paths_;
    std::array<Pixel, batch_size> origin_;
    std::size_t count_ = 0;
    std::uint64_t started_ = 0;
};

class Loop {
  public:
    Loop(Scene const& scene, RenderPlan const& plan, Integrator const& integrator, RenderSettings const& settings,
         Film& film)
        : scene_(scene),
          integrator_(integrator),
          settings_(settings),
          film_(film),
          starter_(scene, plan, film.width(), film.height(), settings.sampler, settings.seed),
          columns_((film.width() + tile_size - 1) / tile_size),
          rows_((film.height() + tile_size - 1) / tile_size) {}

    int tile_count() const { return columns_ * rows_; }
    bool stopped() const { return settings_.interrupted && settings_.interrupted->load(std::memory_order_relaxed); }

    // Samples [first, last) of every pixel of a tile.
    void render_tile(int tile, std::uint32_t first, std::uint32_t last) {
        Batch batch(scene_, integrator_, starter_, film_, statistics_.local());
        int const x0 = tile % columns_ * tile_size, y0 = tile / columns_ * tile_size;
        for (int y = y0; y < std::min(y0 + tile_size, film_.height()); ++y)
            for (int x = x0; x < std::min(x0 + tile_size, film_.width()); ++x)
                for (std::uint32_t s = first; s < last; ++s) batch.start(x, y, s);
        batch.finish();
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
    Scene const& scene_;
    Integrator const& integrator_;
    RenderSettings const& settings_;
    Film& film_;
    PathStarter starter_;
    int columns_, rows_;
    tbb::enumerable_thread_specific<ThreadStatistics> statistics_;
};

// Passes double, so that a time or an error is met closely and the overhead stays small; without either, and with
// progress shown, sixteenths of the whole.
int next_pass(RenderSettings const& s, int done, int together) {
    bool const open_ended = s.seconds || s.relative_error;
    int const wanted = open_ended ? std::max(1, done) : std::max(4, s.spp / 16);
    return std::min({s.spp - done, wanted, together - done % together});
}

}  // namespace

Film make_film(Scene const& scene) {
    FilmSettings const& f = scene.film;
    std::optional<Bands> bands;
    if (f.band_count > 0) bands = Bands{f.band_range, f.band_count};
    return Film(f.width, f.height, cie1931_2deg(), scene.grid, bands);
}

RenderReport render(Scene const& scene, RenderPlan const& plan, Integrator& integrator, RenderSettings const& settings,
                    Film& film) {
    Loop loop(scene, plan, integrator, settings, film);
    RenderReport report;
    Clock::time_point const start = Clock::now();
    // More threads than processors only if they are asked for.
    std::optional<tbb::global_control> more;
    if (settings.threads > tbb::info::default_concurrency())
        more.emplace(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(settings.threads));
    tbb::task_arena arena(settings.threads > 0 ? settings.threads : tbb::task_arena::automatic);
    std::atomic<std::uint64_t> tiles_done{0};
    auto const share = [&] {
        double const in_pass = static_cast<double>(tiles_done) / loop.tile_count();
        if (settings.seconds) return std::min(1.0, seconds_since(start) / *settings.seconds);
        return std::min(1.0, in_pass / settings.spp);
    };
    while (report.spp < settings.spp && !loop.stopped()) {
        int const pass = next_pass(settings, report.spp, integrator.samples_together());
        auto const first = static_cast<std::uint32_t>(report.spp), last = static_cast<std::uint32_t>(report.spp + pass);
        arena.execute([&] {
            integrator.prepare(scene, {settings.seed, first, last}, report.rays);
            tbb::parallel_for(0, loop.tile_count(), [&](int i) {
                if (loop.stopped()) return;
                int const tile = settings.reversed_tiles ? loop.tile_count() - 1 - i : i;
                loop.render_tile(tile, first, last);
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
    report.rays.add(totals.rays);
    if (totals.timed_ticks > 0)
        report.embree_share = static_cast<double>(totals.rays.traced_ticks) / static_cast<double>(totals.timed_ticks);
    return report;
}

}  // namespace iride
