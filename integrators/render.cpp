// SPDX-License-Identifier: Apache-2.0
#include "integrators/render.h"

#include <tbb/enumerable_thread_specific.h>
#include <tbb/global_control.h>
#include <tbb/info.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "base/clock.h"

namespace iride {

namespace {

constexpr int tile_size = 16;  // pixels: small enough to balance, large enough to keep the caches warm
constexpr std::uint32_t batches_per_timing =
    32;  // every so many batches of a thread, one tells the time spent in Embree

struct ThreadStatistics {
    RayStatistics rays;
    std::uint64_t batches = 0;
    std::uint64_t timed_ticks = 0;  // of whole timed batches
};

// Paths of neighbouring pixels and samples, followed together and added to the film in the order of their start.
class Batch {
  public:
    // Place in the film, or beside it.
    struct Pixel {
        int x, y;
        bool wanted = true;  // false: its path is followed for those of its block alone
    };

    Batch(Scene const& scene, Integrator const& integrator, PathStarter const& starter, Film& film,
          LightGroupFilms* groups, ThreadStatistics& statistics)
        : scene_(scene),
          integrator_(integrator),
          splats_(integrator.splats()),
          may_be_negative_(integrator.may_be_negative()),
          weight_(integrator.weight()),
          starter_(starter),
          film_(film),
          groups_(groups),
          of_group_(groups ? batch_size * groups->count() : 0),
          statistics_(statistics) {}

    void start(std::span<Pixel const> block, std::uint32_t sample) {
        if (count_ + block.size() > batch_size) finish();
        if (count_ == 0) begin_timing();
        CameraPath const* const first = &paths_[count_];
        for (Pixel const& pixel : block) {
            origin_[count_] = pixel;
            if (groups_) paths_[count_].shares = empty_shares(count_);
            starter_.start(pixel.x + film_.place().x0, pixel.y + film_.place().y0, sample, paths_[count_++], first);
        }
        if (count_ == batch_size) finish();
    }
    void finish() {
        if (count_ == 0) return;
        integrator_.follow(scene_, std::span(paths_).first(count_), statistics_.rays);
        for (std::size_t i = 0; i < count_; ++i)
            if (origin_[i].wanted) deposit(origin_[i], paths_[i]);
        if (splats_) film_.count_light_paths(light_paths_, weight_);
        count_ = light_paths_ = 0;
        if (statistics_.rays.timed) statistics_.timed_ticks += processor_ticks() - started_;
    }

  private:
    void begin_timing() {
        statistics_.rays.timed = statistics_.batches++ % batches_per_timing == batches_per_timing / 2;
        if (statistics_.rays.timed) started_ = processor_ticks();
    }
    LightShares empty_shares(std::size_t path) {
        Radiance* const first = of_group_.data() + path * groups_->count();
        std::fill_n(first, groups_->count(), Radiance());
        return groups_->shares(first);
    }
    std::optional<Rejection> why_rejected(CameraPath const& path) const {
        if (!path.complete) return Rejection::path_too_long;
        if (!is_finite(path.radiance)) return Rejection::not_finite;
        if (!may_be_negative_ && is_negative(path.radiance)) return Rejection::negative;
        return std::nullopt;
    }
    void deposit(Pixel const& p, CameraPath const& path) {
        auto const cause = why_rejected(path);
        if (cause) {
            film_.reject(p.x, p.y, *cause);
        } else {
            film_.add(p.x, p.y, path.wavelengths, path.radiance, weight_);
            if (splats_) film_.accompany(p.x, p.y, weight_);
        }
        if (groups_ && cause)
            groups_->reject(p.x, p.y, *cause);
        else if (groups_)
            groups_->add(p.x, p.y, path.wavelengths, path.shares);
        if (!splats_ || !path.complete) return;
        ++light_paths_;
        for (Splat const& splat : path.splats)
            starter_.spread(splat, [&](int x, int y, float weight) {
                film_.splat(x, y, path.wavelengths, splat.radiance * weight, weight_);
            });
    }

    Scene const& scene_;
    Integrator const& integrator_;
    bool splats_, may_be_negative_;
    std::uint32_t weight_;
    PathStarter const& starter_;
    Film& film_;
    LightGroupFilms* groups_;
    std::vector<Radiance> of_group_;  // [path][group]
    ThreadStatistics& statistics_;
    std::array<CameraPath, batch_size> paths_;
    std::array<Pixel, batch_size> origin_;
    std::size_t count_ = 0, light_paths_ = 0;
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
          starter_(scene, plan, film.place().picture_width, film.place().picture_height, settings.sampler,
                   settings.seed),
          side_(integrator.block_side()),
          x0_(film.place().x0 / tile_size * tile_size - film.place().x0),
          y0_(film.place().y0 / tile_size * tile_size - film.place().y0),
          columns_((film.width() - x0_ + tile_size - 1) / tile_size),
          rows_((film.height() - y0_ + tile_size - 1) / tile_size) {}

    int tile_count() const { return columns_ * rows_; }
    bool stopped() const { return settings_.interrupted && settings_.interrupted->load(std::memory_order_relaxed); }

    // What every pixel of a tile lacks of `goal` samples, or of its own goal.
    void render_tile(int tile, std::uint32_t goal) {
        Batch batch(scene_, integrator_, starter_, film_, settings_.groups, statistics_.local());
        int const x0 = x0_ + tile % columns_ * tile_size, y0 = y0_ + tile / columns_ * tile_size;
        for (int y = y0; y < std::min(y0 + tile_size, film_.height()); y += side_)
            for (int x = x0; x < std::min(x0 + tile_size, film_.width()); x += side_) render_block(batch, x, y, goal);
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
    // The block whose first pixel is (x0, y0): all its pixels that are in the picture, whether or not in the film.
    void render_block(Batch& batch, int x0, int y0, std::uint32_t goal) {
        std::array<Batch::Pixel, most_in_block> block;
        std::array<std::uint32_t, most_in_block> from, to;
        std::size_t count = 0;
        std::uint32_t first = goal, last = 0;
        for (int y = y0; y < std::min(y0 + side_, film_.place().picture_height - film_.place().y0); ++y)
            for (int x = x0; x < std::min(x0 + side_, film_.place().picture_width - film_.place().x0); ++x) {
                block[count] = {x, y};
                from[count] = to[count] = 0;
                if (x >= 0 && y >= 0 && x < film_.width() && y < film_.height()) {
                    from[count] = film_.pixel(x, y).taken();
                    to[count] = settings_.goals ? settings_.goals->at(x, y) : goal;
                    first = std::min(first, from[count]), last = std::max(last, to[count]);
                }
                ++count;
            }
        for (std::uint32_t s = first; s < last; ++s) {
            for (std::size_t i = 0; i < count; ++i) block[i].wanted = from[i] <= s && s < to[i];
            if (std::ranges::any_of(std::span(block).first(count), &Batch::Pixel::wanted))
                batch.start(std::span(block).first(count), settings_.first_sample + s);
        }
    }

    Scene const& scene_;
    Integrator const& integrator_;
    RenderSettings const& settings_;
    Film& film_;
    PathStarter starter_;
    int side_;     // of a block
    int x0_, y0_;  // of the first tile: tiles are those of the whole picture, so that none cuts a block
    int columns_, rows_;
    tbb::enumerable_thread_specific<ThreadStatistics> statistics_;
};

// Passes double, so that a time or an error is met closely and the overhead stays small; without either, and with
// progress shown, sixteenths of the whole.
int next_pass(RenderSettings const& s, int done, Integrator const& integrator,
              std::optional<double> seconds_per_sample) {
    bool const open_ended = s.seconds || s.stop_at;
    int const wanted = open_ended ? std::max(1, done) : std::max(4, s.spp / 16);
    double const in_time = open_ended || !std::isfinite(s.pass_seconds) ? wanted
                           : seconds_per_sample ? std::max(1.0, s.pass_seconds / *seconds_per_sample)
                                                : 1;
    int const alike = integrator.samples_alike(s.first_sample + static_cast<std::uint32_t>(done));
    return std::min({s.spp - done, in_time < wanted ? static_cast<int>(in_time) : wanted, alike});
}

// Samples that every pixel has.
int samples_of_all(Film const& film) {
    auto const fewest = std::ranges::min_element(film.pixels(), {}, &FilmPixel::taken);
    return static_cast<int>(fewest->taken());
}

bool is_done(RenderSettings const& s, Film const& film) {
    if (!s.goals) return samples_of_all(film) >= s.spp;
    for (std::size_t i = 0; i < film.pixels().size(); ++i)
        if (film.pixels()[i].taken() < s.goals->pixel[i]) return false;
    return true;
}

}  // namespace

Film make_film(Scene const& scene, std::optional<Crop> const& crop) {
    FilmSettings const& f = scene.film;
    std::optional<Bands> bands;
    if (f.band_count > 0) bands = Bands{f.band_range, f.band_count};
    Crop const c = crop.value_or(Crop{0, 0, f.width, f.height});
    return Film(c.x1 - c.x0, c.y1 - c.y0, {c.x0, c.y0, f.width, f.height}, cie1931_2deg(), scene.grid, bands);
}

RenderReport render(Scene const& scene, RenderPlan const& plan, Integrator& integrator, RenderSettings const& settings,
                    Film& film) {
    Loop loop(scene, plan, integrator, settings, film);
    RenderReport report;
    std::uint64_t const paths_before = film.total_samples();
    Clock::time_point const start = Clock::now();
    // More threads than processors only if they are asked for.
    std::optional<tbb::global_control> more;
    if (settings.threads > tbb::info::default_concurrency())
        more.emplace(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(settings.threads));
    tbb::task_arena arena(settings.threads > 0 ? settings.threads : tbb::task_arena::automatic);
    std::atomic<std::uint64_t> tiles_done{0};
    int const before = report.spp = samples_of_all(film);
    auto const share = [&] {
        double const in_pass = static_cast<double>(tiles_done) / loop.tile_count();
        if (settings.seconds) return std::min(1.0, seconds_since(start) / *settings.seconds);
        return std::min(1.0, settings.goals ? in_pass : (before + in_pass) / settings.spp);
    };
    while (!is_done(settings, film) && !loop.stopped()) {
        std::optional<double> per_sample;
        if (report.spp > before) per_sample = seconds_since(start) / (report.spp - before);
        int const pass = settings.goals ? 1 : next_pass(settings, report.spp, integrator, per_sample);
        auto const first = static_cast<std::uint32_t>(report.spp);
        std::uint32_t const last =
            settings.goals ? std::ranges::max(settings.goals->pixel) : first + static_cast<std::uint32_t>(pass);
        arena.execute([&] {
            integrator.prepare(scene, {settings.seed, settings.first_sample + first, settings.first_sample + last},
                               report.rays);
            if (integrator.splats()) film.add_splat_layer();
            tbb::parallel_for(0, loop.tile_count(), [&](int i) {
                if (loop.stopped()) return;
                int const tile = settings.reversed_tiles ? loop.tile_count() - 1 - i : i;
                loop.render_tile(tile, last);
                tiles_done += static_cast<std::uint64_t>(pass);
                if (settings.on_progress) settings.on_progress(report.spp, share());
            });
        });
        if (loop.stopped()) break;
        report.spp = samples_of_all(film);
        if (settings.on_pass) settings.on_pass();
        if (settings.seconds && seconds_since(start) >= *settings.seconds) break;
        if (settings.stop_at && settings.stop_at->is_reached(film)) break;
    }
    ThreadStatistics const totals = loop.totals();
    report.interrupted = loop.stopped();
    report.seconds = seconds_since(start);
    report.paths = film.total_samples() - paths_before;
    report.rays.add(totals.rays);
    if (totals.timed_ticks > 0)
        report.embree_share = static_cast<double>(totals.rays.traced_ticks) / static_cast<double>(totals.timed_ticks);
    return report;
}

}  // namespace iride
