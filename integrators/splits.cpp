// SPDX-License-Identifier: Apache-2.0
#include "integrators/splits.h"

#include <tbb/parallel_for.h>

#include <array>
#include <cmath>
#include <limits>

#include "film/compare.h"
#include "film/film.h"
#include "integrators/around.h"

namespace iride {

namespace {

constexpr int most_blocks = 128;  // along the picture's longer side
constexpr int side = 2;           // of a block's pilot: 2 x 2 places
// Fewer paths tell less of a noise that few paths make: a stage looks closer, or four times as often.
struct Stage {
    std::uint32_t first_sample;
    int block;   // pixels along a side, at least
    int rounds;  // paths of two parts at each place
};
constexpr std::array<Stage, 3> stages{{{0, 16, 2}, {4, 16, 8}, {16, 8, 8}}};
constexpr std::uint64_t pilot_seed = 0x5911;
constexpr double first_part = 0.15;  // of a path's time: up to its first vertex (measured)
// Of the noise that parts of a path share, from its place and wavelengths: both are stratified, it soon falls faster.
constexpr double shared_part = 0.1;

// What a block of pixels has to say.
struct Pilot {
    double apart = 0;   // relative variance between parts of one path
    double shared = 0;  // between paths, without that
    double rays = 0;    // of a part
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
        Eigen::Array3d const measure = (sum / paths).square() + relmse_floor;
        return {(apart / measure).mean(), (between / measure).mean(), rays / (2 * paths)};
    }

  private:
    Eigen::Array3d colour(int path, int round, int block) const {
        return to_vector(film_.mean(path, block * rounds_ + round)).array();
    }
    Film film_;
    int rounds_;
};

// Block `number` of a row.
Pilot pilot_of(Crop const& block, int number, int rounds, PathStarter const& starter, FollowPaths const& follow,
               Pairs& pairs, RayStatistics& all) {
    std::array<CameraPath, paths_of_block> paths;
    RayStatistics statistics;
    for (int round = 0; round < rounds; ++round) {
        for (int i = 0; i < paths_of_block; ++i) {
            CameraPath& path = paths[static_cast<std::size_t>(i)];
            int const column = i / 2 % side, row = i / 2 / side;
            starter.start(block.x0 + (block.x1 - block.x0) * column / side,
                          block.y0 + (block.y1 - block.y0) * row / side, static_cast<std::uint32_t>(round), path);
            path.sampler.split(static_cast<std::uint32_t>(i % 2), 2);
        }
        follow(paths, statistics);
        for (int i = 0; i < paths_of_block; ++i) pairs.add(i, round, number, paths[static_cast<std::size_t>(i)]);
    }
    all.add(statistics);
    return pairs.result(number, static_cast<double>(statistics.closest_rays + statistics.shadow_rays));
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
                            sum.rays / count};
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

// Time x error, in units of their own.
double inefficiency(Image<Pilot> const& pilot, double factor, int most) {
    double rays = 0, time = 0, error = 0;
    for (Pilot const& p : pilot.pixel) rays += p.rays;
    double const first = first_part * rays / static_cast<double>(pilot.pixel.size());
    for (Pilot const& p : pilot.pixel) {
        int const parts = parts_of(p, factor, most);
        time += first + (1 - first_part) * parts * p.rays;
        error += p.apart / parts + shared_part * p.shared;
    }
    return time * error;
}

// Of a geometric series; 0, for which nothing is split, among them.
double best_factor(Image<Pilot> const& pilot, int most) {
    double highest = 0;  // beyond which all have `most`
    for (Pilot const& p : pilot.pixel)
        if (p.apart > 0 && p.rays > 0) highest = std::max(highest, 2 * most * std::sqrt(p.rays / p.apart));
    double best = 0, least = inefficiency(pilot, 0, most);
    constexpr int steps = 120;
    for (int i = 0; i < steps; ++i) {
        double const factor = highest * std::pow(10, -0.05 * i), here = inefficiency(pilot, factor, most);
        if (here < least) least = here, best = factor;
    }
    return best;
}

}  // namespace

Splits::Splits(Image<std::uint8_t> parts, int width, int height)
    : parts_(std::move(parts)),
      columns_per_pixel_(static_cast<float>(parts_.width) / static_cast<float>(width)),
      rows_per_pixel_(static_cast<float>(parts_.height) / static_cast<float>(height)) {}

SplitPilot::SplitPilot(Scene const& scene, RenderPlan const& plan, int most)
    : starter_(scene, plan, scene.film.width, scene.film.height, SamplerKind::sobol, pilot_seed), most_(most) {}

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

Splits SplitPilot::learn(Scene const& scene, std::uint32_t first, FollowPaths const& follow,
                         RayStatistics& statistics) {
    latest_ = stage_of(first);
    Stage const& stage = stages[static_cast<std::size_t>(latest_)];
    int const width = scene.film.width, height = scene.film.height,
              block = std::max(stage.block, (std::max(width, height) + most_blocks - 1) / most_blocks);
    Image<Pilot> pilot(std::max(1, width / block), std::max(1, height / block));
    std::vector<RayStatistics> of_row(static_cast<std::size_t>(pilot.height));
    tbb::parallel_for(0, pilot.height, [&](int y) {
        Pairs pairs(scene, pilot.width, stage.rounds);
        for (int x = 0; x < pilot.width; ++x)
            pilot.at(x, y) = pilot_of({width * x / pilot.width, height * y / pilot.height,
                                       width * (x + 1) / pilot.width, height * (y + 1) / pilot.height},
                                      x, stage.rounds, starter_, follow, pairs, of_row[static_cast<std::size_t>(y)]);
    });
    for (RayStatistics const& row : of_row) statistics.add(row);
    pilot = spread(pilot);
    double const factor = best_factor(pilot, most_);
    if (!(factor > 0)) return {};
    Image<std::uint8_t> parts(pilot.width, pilot.height);
    for (std::size_t i = 0; i < parts.pixel.size(); ++i)
        parts.pixel[i] = static_cast<std::uint8_t>(parts_of(pilot.pixel[i], factor, most_));
    return Splits(std::move(parts), width, height);
}

}  // namespace iride
