// SPDX-License-Identifier: Apache-2.0
#include "integrators/splits.h"

#include <tbb/parallel_for.h>

#include <array>
#include <cmath>
#include <limits>
#include <numeric>

#include "film/compare.h"
#include "film/film.h"
#include "integrators/around.h"

namespace iride {

namespace {

constexpr int most_blocks = 128;  // along the picture's longer side
constexpr int most_sighted = 32;  // along either side, of those in which light paths are seen
constexpr int side = 2;           // of a block's pilot: 2 x 2 places
// The first sample is whole and goes without light paths, unless their number was asked for: often it is enough. Fewer
// paths tell less of a noise that few paths make: a stage looks closer, or four times as often.
struct Stage {
    std::uint32_t first_sample;
    int block;    // pixels along a side, at least
    int rounds;   // paths of two parts at each place
    int most;     // parts of a path: the first samples must not take long
    double pays;  // time x error of whole paths over that of parts, as foreseen, for which paths are split
};
constexpr int any_number = std::numeric_limits<int>::max();
// Few whole paths are more evenly spread than is foreseen: .6 to .8 of the gain is found (measured).
constexpr double early = 1.35;
constexpr std::array<Stage, 4> stages{
    {{0, 0, 0, 1, 1}, {1, 16, 2, 4, early}, {4, 16, 8, 8, early}, {16, 8, 8, any_number, 1}}};
constexpr std::uint64_t pilot_seed = 0x5911;
constexpr double first_part = 0.15;  // of a path's time: up to its first vertex (measured)
// Of the noise that parts of a path share, from its place and wavelengths: both are stratified, it soon falls faster.
constexpr double shared_part = 0.1;
constexpr double light_ray = 1.5;  // what a ray of a light path costs, in rays of camera paths (measured)
// What a sample with light paths is worth beside one without, in scenes with caustics (measured: 3 to 8).
constexpr double worth_of_light_paths = 4;

// What a block of pixels has to say.
struct Pilot {
    double apart = 0;              // relative variance between parts of one path
    double shared = 0;             // between paths, without that
    double rays = 0;               // of a part
    Eigen::Array3d mean{0, 0, 0};  // X, Y, Z
};

constexpr int paths_of_block = 2 * side * side;

// Colours of the paths of a row of blocks, that are taken two and two as parts of one.
class Pairs {
  public:
    Pairs(Scene const& scene, int blocks, int rounds)
        : film_(paths_of_block, rounds * blocks, cie1931_2deg(), scene.grid), rounds_(rounds) {}
    void add(int path, int round, int block, CameraPath const& p) {
        if (p.complete && is_finite(p.radiance)) film_.add(path, block * rounds_ + round, p.wavelengths, p.radiance);
    }
    Pilot result(int block, double rays) const {
        Eigen::Array3d sum(0, 0, 0), apart(0, 0, 0), between(0, 0, 0);
        for (int i = 0; i < paths_of_block; i += 2) {
            Eigen::Array3d before(0, 0, 0);
            for (int r = 0; r < rounds_; ++r) {
                Eigen::Array3d const a = colour(i, r, block), b = colour(i + 1, r, block), both = (a + b) / 2;
                sum += both;
                apart += (a - b).square() / 2;
                if (r > 0) between += (both - before).square() / 2;
                before = both;
            }
        }
        constexpr double places = side * side;
        double const paths = places * rounds_;
        apart /= paths;
        between = between / (places * (rounds_ - 1)) - apart / 2;
        Eigen::Array3d const mean = sum / paths, measure = mean.square() + relmse_floor;
        return {(apart / measure).mean(), (between / measure).mean(), rays / (2 * paths), mean};
    }

  private:
    Eigen::Array3d colour(int path, int round, int block) const {
        return to_vector(film_.mean(path, block * rounds_ + round)).array();
    }
    Film film_;
    int rounds_;
};

// The blocks of a pilot, each with the same number of paths: two parts of one follow each other.
class Blocks {
  public:
    using Paths = std::array<CameraPath, paths_of_block>;

    Blocks(Scene const& scene, int least_side, int rounds_of_each, PathStarter const& starter)
        : rounds(rounds_of_each), width_(scene.film.width), height_(scene.film.height), starter_(starter) {
        int const block = std::max(least_side, (std::max(width_, height_) + most_blocks - 1) / most_blocks);
        columns = std::max(1, width_ / block), rows = std::max(1, height_ / block);
    }
    // use(paths, round) for each round of block (x, y).
    template <class Use>
    void for_each_round(int x, int y, Use&& use) const {
        Paths paths;
        int const x0 = width_ * x / columns, x1 = width_ * (x + 1) / columns, y0 = height_ * y / rows,
                  y1 = height_ * (y + 1) / rows;
        for (int round = 0; round < rounds; ++round) {
            for (int i = 0; i < paths_of_block; ++i) {
                CameraPath& path = paths[static_cast<std::size_t>(i)];
                starter_.start(x0 + (x1 - x0) * (i / 2 % side) / side, y0 + (y1 - y0) * (i / 2 / side) / side,
                               static_cast<std::uint32_t>(round), path);
                path.sampler.split(static_cast<std::uint32_t>(i % 2), 2);
            }
            use(paths, round);
        }
    }
    template <class Use>
    void for_each_row(Use&& use) const {
        tbb::parallel_for(0, rows, use);
    }

    int columns, rows, rounds;

  private:
    int width_, height_;
    PathStarter const& starter_;
};

Image<Pilot> pilot_of(Scene const& scene, Blocks const& blocks, FollowPaths const& follow, RayStatistics& all) {
    Image<Pilot> pilot(blocks.columns, blocks.rows);
    std::vector<RayStatistics> of_row(static_cast<std::size_t>(blocks.rows));
    Pairs const none(scene, blocks.columns, blocks.rounds);
    blocks.for_each_row([&](int y) {
        Pairs pairs = none;
        for (int x = 0; x < blocks.columns; ++x) {
            RayStatistics statistics;
            blocks.for_each_round(x, y, [&](Blocks::Paths& paths, int round) {
                follow(paths, statistics);
                for (int i = 0; i < paths_of_block; ++i) pairs.add(i, round, x, paths[static_cast<std::size_t>(i)]);
            });
            pilot.at(x, y) = pairs.result(x, static_cast<double>(statistics.rays()));
            of_row[static_cast<std::size_t>(y)].add(statistics);
        }
    });
    for (RayStatistics const& row : of_row) all.add(row);
    return pilot;
}

// What light paths show, in blocks that may be larger: each row of a pilot sees all of them.
class Sighted {
  public:
    Sighted(Scene const& scene, Blocks const& blocks)
        : film_(std::min(most_sighted, blocks.columns), std::min(most_sighted, blocks.rows), cie1931_2deg(),
                scene.grid),
          columns_per_pixel_(static_cast<double>(film_.width()) / scene.film.width),
          rows_per_pixel_(static_cast<double>(film_.height()) / scene.film.height),
          pixels_(static_cast<double>(scene.film.width) * scene.film.height) {}

    void add(CameraPath const& path, PathStarter const& starter) {
        ++paths_;
        for (Splat const& splat : path.splats)
            starter.spread(splat, [&](int x, int y, float weight) {
                if (is_finite(splat.radiance))
                    film_.add(static_cast<int>(x * columns_per_pixel_), static_cast<int>(y * rows_per_pixel_),
                              path.wavelengths, splat.radiance * weight);
            });
    }
    void add(Sighted const& other) {
        film_.add(other.film_);
        rays.add(other.rays);
        paths_ += other.paths_;
    }
    int width() const { return film_.width(); }
    int height() const { return film_.height(); }
    // What a light path for each pixel brings to one of block (x, y): few hit it, so the variance is the mean square.
    Eigen::Array3d mean(int x, int y) const { return of_pixel(film_.pixel(x, y).sum); }
    Eigen::Array3d variance(int x, int y) const { return of_pixel(film_.pixel(x, y).sum_of_squares) / pixels_; }
    double rays_of_path() const { return static_cast<double>(rays.rays()) / paths_; }

    RayStatistics rays;

  private:
    Eigen::Array3d of_pixel(std::array<double, 3> const& sum) const {
        return Eigen::Array3d(sum[0], sum[1], sum[2]) * (columns_per_pixel_ * rows_per_pixel_ / paths_);
    }
    Film film_;
    double columns_per_pixel_, rows_per_pixel_, pixels_, paths_ = 0;
};

Sighted sighted_by(Scene const& scene, Blocks const& blocks, LightPathsBeside const& beside, Splits const& splits,
                   PathStarter const& starter) {
    std::vector<Sighted> of_row(static_cast<std::size_t>(blocks.rows), Sighted(scene, blocks));
    blocks.for_each_row([&](int y) {
        Sighted& row = of_row[static_cast<std::size_t>(y)];
        for (int x = 0; x < blocks.columns; ++x)
            blocks.for_each_round(x, y, [&](Blocks::Paths& paths, int) {
                beside.follow(paths, splits, row.rays);
                for (CameraPath const& path : paths) row.add(path, starter);
            });
    });
    for (std::size_t row = 1; row < of_row.size(); ++row) of_row[0].add(of_row[row]);
    return std::move(of_row[0]);
}

// Few paths see little: what one block finds its neighbours may have missed.
Image<Pilot> spread(Image<Pilot> const& found) {
    Image<Pilot> out(found.width, found.height);
    for (int y = 0; y < found.height; ++y)
        for (int x = 0; x < found.width; ++x) {
            Pilot sum;
            int const count = for_each_around(found, x, y, 1, [&](Pilot const& p) {
                sum.apart += p.apart, sum.shared += p.shared, sum.rays += p.rays;
            });
            out.at(x, y) = {std::max(found.at(x, y).apart, sum.apart / count), std::max(0.0, sum.shared / count),
                            sum.rays / count, found.at(x, y).mean};
        }
    return out;
}

// The power of two next to factor sqrt(v / c).
int parts_of(Pilot const& p, double factor, int most) {
    double const wanted = p.rays > 0 ? factor * std::sqrt(p.apart / p.rays) : 1;
    int parts = 1;
    while (2 * parts <= most && wanted > std::sqrt(2.0) * parts) parts *= 2;
    return parts;
}

double mean_of(Image<std::uint8_t> const& parts) {
    return std::accumulate(parts.pixel.begin(), parts.pixel.end(), 0.0) / static_cast<double>(parts.pixel.size());
}

// Of a sample, block by block together.
struct Cost {
    double time = 0;  // rays
    double error = 0;
    double product() const { return time * error; }
};
Cost cost_of(Image<Pilot> const& pilot, double factor, int most) {
    double rays = 0;
    for (Pilot const& p : pilot.pixel) rays += p.rays;
    double const first = first_part * rays / static_cast<double>(pilot.pixel.size());
    Cost cost;
    for (Pilot const& p : pilot.pixel) {
        int const parts = parts_of(p, factor, most);
        cost.time += first + (1 - first_part) * parts * p.rays;
        cost.error += p.apart / parts + shared_part * p.shared;
    }
    return cost;
}

// Of a geometric series; 0, for which nothing is split, where none `pays`.
double best_factor(Image<Pilot> const& pilot, int most, double pays) {
    double highest = 0;  // beyond which all have `most`
    for (Pilot const& p : pilot.pixel)
        if (p.apart > 0 && p.rays > 0) highest = std::max(highest, 2 * most * std::sqrt(p.rays / p.apart));
    double best = 0, least = cost_of(pilot, 0, most).product() / pays;
    constexpr int steps = 120;
    for (int i = 0; i < steps; ++i) {
        double const factor = highest * std::pow(10, -0.05 * i), here = cost_of(pilot, factor, most).product();
        if (here < least) least = here, best = factor;
    }
    return best;
}

// What camera paths bring to each block of `sighted`, and light paths around it.
Image<Eigen::Array3d> mean_around(Image<Pilot> const& pilot, Sighted const& sighted) {
    Image<Eigen::Array3d> shown(sighted.width(), sighted.height()), mean(shown.width, shown.height);
    Image<int> count(shown.width, shown.height);
    std::ranges::fill(mean.pixel, Eigen::Array3d(0, 0, 0));
    for (int y = 0; y < pilot.height; ++y)
        for (int x = 0; x < pilot.width; ++x) {
            int const u = x * mean.width / pilot.width, v = y * mean.height / pilot.height;
            mean.at(u, v) += pilot.at(x, y).mean;
            ++count.at(u, v);
        }
    for (int y = 0; y < shown.height; ++y)
        for (int x = 0; x < shown.width; ++x) shown.at(x, y) = sighted.mean(x, y);
    for (int y = 0; y < mean.height; ++y)
        for (int x = 0; x < mean.width; ++x) {
            Eigen::Array3d around(0, 0, 0);
            int const cells = for_each_around(shown, x, y, 1, [&](Eigen::Array3d const& one) { around += one; });
            mean.at(x, y) = mean.at(x, y) / count.at(x, y) + around / cells;
        }
    return mean;
}

// Of camera paths, that light paths of which `sighted` saw some, with a share of their own, should go with.
float best_share(Image<Pilot> const& pilot, Cost const& parts, Sighted const& sighted, float share) {
    Image<Eigen::Array3d> const mean = mean_around(pilot, sighted);
    double error = 0;
    for (int y = 0; y < mean.height; ++y)
        for (int x = 0; x < mean.width; ++x)
            error += (sighted.variance(x, y) / (mean.at(x, y).square() + relmse_floor)).mean();
    error /= static_cast<double>(mean.pixel.size());
    double const time = light_ray * sighted.rays_of_path();
    if (!(time > 0 && parts.error > 0)) return share;
    double const best = static_cast<double>(share) * std::sqrt(error / time * parts.time / parts.error);
    constexpr double least = 0.1, most = 1;
    return static_cast<float>(std::clamp(best, least, most));
}

}  // namespace

Splits::Splits(Image<std::uint8_t> parts, int width, int height)
    : parts_(std::move(parts)),
      columns_per_pixel_(static_cast<float>(parts_.width) / static_cast<float>(width)),
      rows_per_pixel_(static_cast<float>(parts_.height) / static_cast<float>(height)) {}

int SplitPilot::stage_of(std::uint32_t sample) {
    int stage = 0;
    while (stage + 1 < static_cast<int>(stages.size()) &&
           sample >= stages[static_cast<std::size_t>(stage + 1)].first_sample)
        ++stage;
    return stage;
}

int SplitPilot::samples_alike(std::uint32_t first) const {
    auto const next = static_cast<std::size_t>(stage_of(first) + 1);
    return next < stages.size() ? static_cast<int>(stages[next].first_sample - first) : std::numeric_limits<int>::max();
}

LearntSplits SplitPilot::learn(Scene const& scene, std::uint32_t sample, FollowPaths const& follow,
                               LightPathsBeside const& beside, RayStatistics& statistics) {
    latest_ = stage_of(sample);
    weight_ = 1;
    Stage const& stage = stages[static_cast<std::size_t>(latest_)];
    if (stage.rounds == 0) return {{}, beside.follow ? std::optional(0.0f) : std::nullopt};
    if (!starter_) starter_.emplace(scene, plan_, scene.film.width, scene.film.height, SamplerKind::sobol, pilot_seed);
    Blocks const blocks(scene, stage.block, stage.rounds, *starter_);
    Image<Pilot> const pilot = spread(pilot_of(scene, blocks, follow, statistics));
    int const most = std::min(most_, stage.most);
    double const factor = best_factor(pilot, most, stage.pays);
    LearntSplits learnt;
    double worth = 1;
    if (factor > 0) {
        Image<std::uint8_t> parts(pilot.width, pilot.height);
        std::ranges::transform(pilot.pixel, parts.pixel.begin(),
                               [&](Pilot const& p) { return static_cast<std::uint8_t>(parts_of(p, factor, most)); });
        worth = mean_of(parts);
        learnt.splits = Splits(std::move(parts), scene.film.width, scene.film.height);
    }
    if (beside.follow) {
        Sighted const sighted = sighted_by(scene, blocks, beside, learnt.splits, *starter_);
        statistics.add(sighted.rays);
        learnt.light_paths = best_share(pilot, cost_of(pilot, factor, most), sighted, beside.share);
        worth *= worth_of_light_paths;
    }
    weight_ = static_cast<std::uint32_t>(std::lround(worth));
    return learnt;
}

}  // namespace iride
