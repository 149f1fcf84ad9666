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

// Pixels: small enough to balance, large enough to keep the caches warm, and not to cut up many blocks of neighbours.
constexpr int tile_of_pixels = 16, tile_of_blocks = 32;
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
                   settings.seed) {}

    // After the integrator is prepared for it.
    void begin_pass() {
        FilmPlace const& p = film_.place();
        side_ = integrator_.block_side();
        tile_size_ = side_ > 1 ? tile_of_blocks : tile_of_pixels;
        x0_ = p.x0 / tile_size_ * tile_size_ - p.x0, y0_ = p.y0 / tile_size_ * tile_size_ - p.y0;
        columns_ = (film_.width() - x0_ + tile_size_ - 1) / tile_size_;
        rows_ = (film_.height() - y0_ + tile_size_ - 1) / tile_size_;
    }
    // Of the film, in a tile.
    int pixels_of(int tile) const {
        Rectangle const r = tile_at(tile);
        return (std::min(r.x1, film_.width()) - std::max(r.x0, 0)) *
               (std::min(r.y1, film_.height()) - std::max(r.y0, 0));
    }
    int tile_count() const { return columns_ * rows_; }
    bool stopped() const { return settings_.interrupted && settings_.interrupted->load(std::memory_order_relaxed); }

    // What every pixel of a tile lacks of `goal` samples, or of its own goal.
    void render_tile(int tile, std::uint32_t goal) {
        Batch batch(scene_, integrator_, starter_, film_, settings_.groups, statistics_.local());
        Rectangle const all = tile_at(tile);
        if (side_ == 1)
            for_each_block(all, 1, 0, 0, [&](Rectangle const& pixel) { render_samples(batch, pixel, goal); });
        else
            render_blocks(batch, all, goal);
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
    // Of pixels of the film, or beside it.
    struct Rectangle {
        int x0, y0, x1, y1;
    };
    Rectangle tile_at(int tile) const {
        int const x = x0_ + tile % columns_ * tile_size_, y = y0_ + tile / columns_ * tile_size_;
        return {x, y, std::min(x + tile_size_, film_.place().picture_width - film_.place().x0),
                std::min(y + tile_size_, film_.place().picture_height - film_.place().y0)};
    }
    // Blocks of a grid that is moved by (dx, dy), cut off at the rectangle's edges.
    template <class Visit>
    static void for_each_block(Rectangle const& r, int side, int dx, int dy, Visit&& visit) {
        for (int y = r.y0 - dy; y < r.y1; y += side)
            for (int x = r.x0 - dx; x < r.x1; x += side)
                visit({std::max(x, r.x0), std::max(y, r.y0), std::min(x + side, r.x1), std::min(y + side, r.y1)});
    }
    // Sample by sample, in blocks that are moved by half their side: what neighbours have in common is not seen as a
    // grid, and a quarter of a block is still one of those that the sampler zsobol shares numbers out to.
    void render_blocks(Batch& batch, Rectangle const& tile, std::uint32_t goal) {
        auto const [first, last] = lacking(tile, goal);
        for (std::uint32_t s = first; s < last; ++s) {
            auto const moved = [&](int bit) { return (settings_.first_sample + s) >> bit & 1 ? side_ / 2 : 0; };
            for_each_block(tile, side_, moved(0), moved(1),
                           [&](Rectangle const& block) { render_block(batch, block, s, goal); });
        }
    }
    void render_samples(Batch& batch, Rectangle const& block, std::uint32_t goal) {
        auto const [first, last] = lacking(block, goal);
        for (std::uint32_t s = first; s < last; ++s) render_block(batch, block, s, goal);
    }
    // Samples [first, second) that some of the pixels lack.
    std::pair<std::uint32_t, std::uint32_t> lacking(Rectangle const& r, std::uint32_t goal) const {
        std::pair<std::uint32_t, std::uint32_t> s{goal, 0};
        for (int y = std::max(0, r.y0); y < std::min(r.y1, film_.height()); ++y)
            for (int x = std::max(0, r.x0); x < std::min(r.x1, film_.width()); ++x)
                s = {std::min(s.first, film_.pixel(x, y).taken()), std::max(s.second, goal_of(x, y, goal))};
        return s;
    }
    std::uint32_t goal_of(int x, int y, std::uint32_t goal) const {
        return settings_.goals ? settings_.goals->at(x, y) : goal;
    }
    // A sample of all pixels of a block, if one lacks it: of those, too, that do not, or are not in the film.
    void render_block(Batch& batch, Rectangle const& r, std::uint32_t sample, std::uint32_t goal) {
        std::array<Batch::Pixel, most_in_block> block;
        std::size_t count = 0;
        bool any = false;
        for (int y = r.y0; y < r.y1; ++y)
            for (int x = r.x0; x < r.x1; ++x) {
                bool const wanted = x >= 0 && y >= 0 && x < film_.width() && y < film_.height() &&
                                    film_.pixel(x, y).taken() <= sample && sample < goal_of(x, y, goal);
                block[count++] = {x, y, wanted};
                any = any || wanted;
            }
        if (any) batch.start(std::span(block).first(count), settings_.first_sample + sample);
    }

    Scene const& scene_;
    Integrator const& integrator_;
    RenderSettings const& settings_;
    Film& film_;
    PathStarter starter_;
    int side_ = 1, tile_size_ = tile_of_pixels;
    int x0_ = 0,
        y0_ = 0;  // of the first tile: tiles are those of the whole picture, and cut the same blocks in its crops
    int columns_ = 0, rows_ = 0;
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
    std::atomic<std::uint64_t> samples_done{0};
    int const before = report.spp = samples_of_all(film);
    auto const share = [&] {
        double const in_pass = static_cast<double>(samples_done) / static_cast<double>(film.pixels().size());
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
            loop.begin_pass();
            tbb::parallel_for(0, loop.tile_count(), [&](int i) {
                if (loop.stopped()) return;
                int const tile = settings.reversed_tiles ? loop.tile_count() - 1 - i : i;
                loop.render_tile(tile, last);
                samples_done += static_cast<std::uint64_t>(pass * loop.pixels_of(tile));
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
