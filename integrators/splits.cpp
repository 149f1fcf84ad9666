// SPDX-License-Identifier: Apache-2.0
#include "integrators/splits.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>

#include "film/compare.h"
#include "integrators/around.h"

namespace iride {

namespace {

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
constexpr double first_part = 0.15;  // of a path's time: up to its first vertex (measured)
// Of the noise that parts of a path share, from its place and wavelengths: both are stratified, it soon falls faster.
constexpr double shared_part = 0.1;
constexpr double light_ray = 1.5;  // what a ray of a light path costs, in rays of camera paths (measured)

// What a block of pixels has to say of splitting.
struct Pilot {
    double apart = 0;   // relative variance between parts of one path
    double shared = 0;  // between paths, without that
    double rays = 0;    // of a part
};
Pilot pilot_of(BlockNoise const& noise) {
    Eigen::Array3d const measure = noise.mean.square() + relmse_floor;
    return {(noise.apart / measure).mean(), (noise.shared / measure).mean(), noise.rays};
}

// Few paths see little: what one block finds its neighbours may have missed.
Image<Pilot> spread(Image<BlockNoise> const& noise) {
    Image<Pilot> found(noise.width, noise.height), out(noise.width, noise.height);
    std::ranges::transform(noise.pixel, found.pixel.begin(), pilot_of);
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

// Of camera paths, that light paths of which `sighted` saw some, with a share of their own, should go with.
float best_share(Image<BlockNoise> const& noise, Cost const& parts, Sighted const& sighted, float share) {
    Image<Eigen::Array3d> const mean = mean_around(each(noise, &BlockNoise::mean), sighted);
    double const error = relative_noise(sighted.variance(), mean);
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
    if (!starter_) starter_.emplace(scene, plan_, PilotStarter::Pairs::parts);
    PilotBlocks const blocks(scene, stage.block);
    Image<BlockNoise> const noise = noise_of(scene, blocks, stage.rounds, *starter_, false, follow, statistics);
    Image<Pilot> const pilot = spread(noise);
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
        Sighted sighted(scene, blocks);
        auto const light_paths = [&](std::span<CameraPath> paths, RayStatistics& rays) {
            beside.follow(paths, learnt.splits, rays);
        };
        noise_of(scene, blocks, stage.rounds, *starter_, false, light_paths, statistics, &sighted);
        learnt.light_paths = best_share(noise, cost_of(pilot, factor, most), sighted, beside.share);
        worth *= worth_of_light_paths;
    }
    weight_ = static_cast<std::uint32_t>(std::lround(worth));
    return learnt;
}

}  // namespace iride
