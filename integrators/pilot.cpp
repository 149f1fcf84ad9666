// SPDX-License-Identifier: Apache-2.0
#include "integrators/pilot.h"

#include <tbb/parallel_for.h>

#include <algorithm>

#include "film/compare.h"
#include "integrators/around.h"

namespace iride {

namespace {

constexpr std::uint64_t pilot_seed = 0x5911;               // whatever the picture's
constexpr std::uint64_t second_seed = 0x9e3779b97f4a7c15;  // beyond what a picture can have
constexpr int most_blocks = 128;                           // along the picture's longer side
constexpr int most_sighted = 32;                           // along either side, of those in which light paths are seen

// Colours of the paths of a row of blocks.
class ColoursOfRow {
  public:
    ColoursOfRow(Scene const& scene, PilotBlocks const& blocks, int rounds)
        : film_(2 * blocks.places(), rounds * blocks.columns, cie1931_2deg(), scene.grid),
          rounds_(rounds),
          places_(blocks.places()) {}
    void add(int path, int round, int block, CameraPath const& p) {
        if (p.complete && is_finite(p.radiance)) film_.add(path, block * rounds_ + round, p.wavelengths, p.radiance);
    }
    BlockNoise noise(int block, double rays) const {
        BlockNoise noise;
        for (int i = 0; i < places_; ++i) {
            Eigen::Array3d before(0, 0, 0), sum_a = before, sum_b = before;
            for (int r = 0; r < rounds_; ++r) {
                Eigen::Array3d const a = colour(i, r, block), b = colour(i + places_, r, block), both = (a + b) / 2;
                sum_a += a, sum_b += b;
                noise.mean += both;
                noise.apart += (a - b).square() / 2;
                if (r > 0) noise.shared += (both - before).square() / 2;
                before = both;
            }
            noise.of_mean += (sum_a - sum_b).square() / 2;
        }
        double const pairs = places_ * rounds_;
        noise.mean /= pairs;
        noise.apart /= pairs;
        noise.of_mean /= pairs;
        noise.shared = noise.shared / (places_ * (rounds_ - 1)) - noise.apart / 2;
        noise.rays = rays / (2 * pairs);
        return noise;
    }

  private:
    Eigen::Array3d colour(int path, int round, int block) const {
        return to_vector(film_.mean(path, block * rounds_ + round)).array();
    }
    Film film_;
    int rounds_, places_;
};

PathStarter starter_of(Scene const& scene, RenderPlan const& plan, std::uint64_t seed) {
    return PathStarter(scene, plan, scene.film.width, scene.film.height, SamplerKind::sobol, seed);
}

}  // namespace

PilotBlocks::PilotBlocks(Scene const& scene, int least_side, Places places)
    : width_(scene.film.width), height_(scene.film.height), side_(places == Places::neighbours ? widest_block : 2) {
    int const block = std::max(least_side, (std::max(width_, height_) + most_blocks - 1) / most_blocks);
    columns = std::max(1, width_ / block), rows = std::max(1, height_ / block);
}

PilotStarter::PilotStarter(Scene const& scene, RenderPlan const& plan, Pairs pairs)
    : first_(starter_of(scene, plan, pilot_seed)) {
    if (pairs == Pairs::paths) second_.emplace(starter_of(scene, plan, second_seed));
}

void PilotStarter::start(PilotBlocks const& blocks, int x, int y, int round, bool together,
                         PilotBlocks::Paths& paths) const {
    auto const places = static_cast<std::size_t>(blocks.places());
    for (std::size_t i = 0; i < 2 * places; ++i) {
        std::size_t const which = i / places;
        auto const [u, v] = blocks.pixel(x, y, static_cast<int>(i % places));
        CameraPath const* const block = together ? &paths[which * places] : nullptr;
        (second_ && which == 1 ? *second_ : first_).start(u, v, static_cast<std::uint32_t>(round), paths[i], block);
        if (!second_) paths[i].sampler.split(static_cast<std::uint32_t>(which), 2);
    }
}

Sighted::Sighted(Scene const& scene, PilotBlocks const& blocks)
    : film_(std::min(most_sighted, blocks.columns), std::min(most_sighted, blocks.rows), cie1931_2deg(), scene.grid),
      columns_per_pixel_(static_cast<double>(film_.width()) / scene.film.width),
      rows_per_pixel_(static_cast<double>(film_.height()) / scene.film.height),
      pixels_(static_cast<double>(scene.film.width) * scene.film.height) {}

void Sighted::add(CameraPath const& path, PathStarter const& starter) {
    ++paths_;
    for (Splat const& splat : path.splats)
        starter.spread(splat, [&](int x, int y, float weight) {
            if (is_finite(splat.radiance))
                film_.add(static_cast<int>(x * columns_per_pixel_), static_cast<int>(y * rows_per_pixel_),
                          path.wavelengths, splat.radiance * weight);
        });
}

Image<Eigen::Array3d> Sighted::of_pixels(std::array<double, 3> FilmPixel::*sum, double divisor) const {
    Image<Eigen::Array3d> out(width(), height());
    double const scale = columns_per_pixel_ * rows_per_pixel_ / paths_;
    std::ranges::transform(film_.pixels(), out.pixel.begin(), [&](FilmPixel const& p) -> Eigen::Array3d {
        return Eigen::Map<Eigen::Array3d const>((p.*sum).data()) * scale / divisor;
    });
    return out;
}

void Sighted::add(Sighted const& other) {
    film_.add(other.film_);
    paths_ += other.paths_, rays_ += other.rays_;
}

Image<BlockNoise> noise_of(Scene const& scene, PilotBlocks const& blocks, int rounds, PilotStarter const& starter,
                           bool together, FollowPaths const& follow, RayStatistics& all, Sighted* seen) {
    Image<BlockNoise> noise(blocks.columns, blocks.rows);
    auto const rows = static_cast<std::size_t>(blocks.rows);
    std::vector<RayStatistics> rays_of_row(rows);
    std::vector<Sighted> seen_by_row;
    if (seen) seen_by_row.assign(rows, Sighted(scene, blocks));
    ColoursOfRow const none(scene, blocks, rounds);
    tbb::parallel_for(0, blocks.rows, [&](int y) {
        auto const row = static_cast<std::size_t>(y);
        ColoursOfRow colours = none;
        PilotBlocks::Paths room;
        auto const paths = std::span(room).first(static_cast<std::size_t>(2 * blocks.places()));
        for (int x = 0; x < blocks.columns; ++x) {
            RayStatistics statistics;
            for (int round = 0; round < rounds; ++round) {
                starter.start(blocks, x, y, round, together, room);
                follow(paths, statistics);
                for (std::size_t i = 0; i < paths.size(); ++i) colours.add(static_cast<int>(i), round, x, paths[i]);
                if (seen)
                    for (CameraPath const& path : paths) seen_by_row[row].add(path, starter.first());
            }
            noise.at(x, y) = colours.noise(x, statistics.work());
            rays_of_row[row].add(statistics);
        }
    });
    for (std::size_t row = 0; row < rows; ++row) {
        all.add(rays_of_row[row]);
        if (!seen) continue;
        seen->add(seen_by_row[row]);
        seen->count_rays(rays_of_row[row]);
    }
    return noise;
}

Image<Eigen::Array3d> each(Image<BlockNoise> const& noise, Eigen::Array3d BlockNoise::*colour) {
    Image<Eigen::Array3d> of_block(noise.width, noise.height);
    std::ranges::transform(noise.pixel, of_block.pixel.begin(), colour);
    return of_block;
}

Image<Eigen::Array3d> averaged(Image<Eigen::Array3d> const& of_block, int width, int height) {
    Image<Eigen::Array3d> mean(width, height);
    Image<int> count(width, height);
    std::ranges::fill(mean.pixel, Eigen::Array3d(0, 0, 0));
    for (int y = 0; y < of_block.height; ++y)
        for (int x = 0; x < of_block.width; ++x) {
            int const u = x * width / of_block.width, v = y * height / of_block.height;
            mean.at(u, v) += of_block.at(x, y);
            ++count.at(u, v);
        }
    for (std::size_t i = 0; i < mean.pixel.size(); ++i) mean.pixel[i] /= count.pixel[i];
    return mean;
}

double relative_noise(Image<Eigen::Array3d> const& variance, Image<Eigen::Array3d> const& mean) {
    double sum = 0;
    for (std::size_t i = 0; i < mean.pixel.size(); ++i)
        sum += (variance.pixel[i] / (mean.pixel[i].square() + relmse_floor)).mean();
    return sum / static_cast<double>(mean.pixel.size());
}

Image<Eigen::Array3d> mean_around(Image<Eigen::Array3d> const& of_block, Sighted const& sighted) {
    Image<Eigen::Array3d> const shown = sighted.mean();
    Image<Eigen::Array3d> mean = averaged(of_block, shown.width, shown.height);
    for (int y = 0; y < mean.height; ++y)
        for (int x = 0; x < mean.width; ++x) {
            Eigen::Array3d around(0, 0, 0);
            int const cells = for_each_around(shown, x, y, 1, [&](Eigen::Array3d const& one) { around += one; });
            mean.at(x, y) += around / cells;
        }
    return mean;
}

}  // namespace iride
