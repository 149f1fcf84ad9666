// SPDX-License-Identifier: Apache-2.0
// Paths that are followed before those of a picture and are not in it, to tell its noise: as many in each of equal
// blocks of pixels, two at a time from one place.
#pragma once

#include <array>
#include <functional>
#include <optional>

#include "film/film.h"
#include "integrators/integrator.h"

namespace iride {

using FollowPaths = std::function<void(std::span<CameraPath>, RayStatistics&)>;

// What the paths of a block have to say; colours are X, Y, Z.
struct BlockNoise {
    Eigen::Array3d mean{0, 0, 0};
    Eigen::Array3d apart{0, 0, 0};    // variance between the two of a pair
    Eigen::Array3d shared{0, 0, 0};   // between pairs, without that
    Eigen::Array3d of_mean{0, 0, 0};  // between the means of the pairs' firsts and seconds, times how many these are
    double rays = 0;                  // of a path, by their work
};

// The blocks of a picture, of at least `least_side` pixels along a side, and the places in each.
class PilotBlocks {
  public:
    // 2 x 2 that are spread over the block, or those of one of the picture's blocks of neighbours, in its middle.
    enum class Places { apart, neighbours };
    using Paths = std::array<CameraPath, std::size_t{2 * most_in_block}>;

    PilotBlocks(Scene const& scene, int least_side, Places places = Places::apart);
    // The pixel of a place in block (x, y).
    std::array<int, 2> pixel(int x, int y, int place) const {
        return {within(x, columns, width_, place % side_), within(y, rows, height_, place / side_)};
    }

    int count() const { return columns * rows; }
    int places() const { return side_ * side_; }
    bool neighbours() const { return side_ == widest_block; }

    int columns, rows;

  private:
    int within(int block, int blocks, int pixels, int place) const {
        int const first = pixels * block / blocks, end = pixels * (block + 1) / blocks;
        if (!neighbours()) return first + (end - first) * place / side_;
        return std::min(pixels - 1, (first + end) / 2 / widest_block * widest_block + place);
    }
    int width_, height_, side_;
};

// How a pilot's paths begin: in pairs, which are two parts of one path, so that only what is drawn after its first
// vertex is between them, or two paths of independent, stratified samples. The first of all pairs stand before the
// second.
class PilotStarter {
  public:
    enum class Pairs { parts, paths };
    PilotStarter(Scene const& scene, RenderPlan const& plan, Pairs pairs);

    // `together`: neighbours as a block of the picture (Integrator::block_side()), else each path alone.
    void start(PilotBlocks const& blocks, int x, int y, int round, bool together, PilotBlocks::Paths& paths) const;
    PathStarter const& first() const { return first_; }

  private:
    PathStarter first_;
    std::optional<PathStarter> second_;  // of pairs of paths
};

// What light paths show, in blocks that may be larger: each row of a pilot sees all of them.
class Sighted {
  public:
    Sighted(Scene const& scene, PilotBlocks const& blocks);

    void add(CameraPath const& path, PathStarter const& starter);
    void add(Sighted const& other);
    int width() const { return film_.width(); }
    int height() const { return film_.height(); }
    // What a light path for each pixel brings to one, block by block: few hit it, so the variance is the mean square.
    Image<Eigen::Array3d> mean() const { return of_pixels(&FilmPixel::sum, 1); }
    Image<Eigen::Array3d> variance() const { return of_pixels(&FilmPixel::sum_of_squares, pixels_); }
    // Of all paths added here.
    void count_rays(RayStatistics const& rays) { rays_ += rays.work(); }
    double rays_of_path() const { return rays_ / paths_; }

  private:
    Image<Eigen::Array3d> of_pixels(std::array<double, 3> FilmPixel::*sum, double divisor) const;
    Film film_;
    double columns_per_pixel_, rows_per_pixel_, pixels_, paths_ = 0, rays_ = 0;
};

// Follow `rounds` pairs at each place, neighbours together or not; statistics are added to `all`, splats to `seen`
// unless that is null.
Image<BlockNoise> noise_of(Scene const& scene, PilotBlocks const& blocks, int rounds, PilotStarter const& starter,
                           bool together, FollowPaths const& follow, RayStatistics& all, Sighted* seen = nullptr);
// One of the colours, block by block.
Image<Eigen::Array3d> each(Image<BlockNoise> const& noise, Eigen::Array3d BlockNoise::*colour);
// The mean over the blocks in each of width x height cells.
Image<Eigen::Array3d> averaged(Image<Eigen::Array3d> const& of_block, int width, int height);

// The mean over all cells, and X, Y and Z, of variance / mean^2.                                          [as relMSE]
double relative_noise(Image<Eigen::Array3d> const& variance, Image<Eigen::Array3d> const& mean);

// What camera paths bring to each block of `sighted`, and light paths around it.
Image<Eigen::Array3d> mean_around(Image<Eigen::Array3d> const& of_block, Sighted const& sighted);

}  // namespace iride
