// SPDX-License-Identifier: Apache-2.0
#include "colour/reflectance_table.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <mutex>

#include "colour/rgb_to_spectrum.h"
#include "colour/sigmoid_fit.h"

namespace iride {

namespace {

using Coefficients = Eigen::Vector3d;

constexpr double served = 0.01;      // CIE 1976 difference at which a texel has its colour
constexpr double unreachable = 0.1;  // at which it has not
constexpr FitEffort texel_effort{served, 30}, node_effort{1e-3, 30};
constexpr double grey_rounding = 1e-6;     // relative: of floats through a transfer curve and a filter
constexpr double steepest_argument = 1e9;  // of a grey 0 or 1: a float as near to it as makes no difference

SigmoidShape shape_of(Coefficients const& c) { return {c[0], c[1], c[2]}; }
Coefficients coefficients_of(SigmoidShape const& s) { return {s.a, s.b, s.c}; }

// The colour as the fitter takes it: XYZ over that of the white.
class ToRatio {
  public:
    explicit ToRatio(RgbSpace const& space)
        : matrix_(to_vector(to_xyz(space.white, 1)).cwiseInverse().asDiagonal() * space.to_xyz_matrix()) {}
    VectorDouble operator()(Eigen::Vector3d const& rgb) const { return matrix_ * rgb; }

  private:
    MatrixDouble matrix_;
};

class ReflectanceTable {
  public:
    ReflectanceTable(RgbSpace const& space, SigmoidFitter const& fitter)
        : node_(3 * sides * sides * heights), to_ratio_(space) {
        tbb::parallel_for(std::size_t{0}, 3 * sides * sides, [&](std::size_t column) { fill(fitter, column); });
    }

    // Near the coefficients of a colour in the cube.
    Coefficients at(Eigen::Vector3d const& rgb) const {
        Eigen::Index largest;
        double const m = rgb.maxCoeff(&largest);
        if (!(m > 0)) return node_[0];
        auto const k = static_cast<std::size_t>(largest);
        Cell const x = cell(rgb[static_cast<Eigen::Index>((k + 1) % 3)] / m * (sides - 1), sides);
        Cell const y = cell(rgb[static_cast<Eigen::Index>((k + 2) % 3)] / m * (sides - 1), sides);
        Cell const z = cell(height_of(m) * (heights - 1), heights);
        Coefficients sum = Coefficients::Zero();
        for (std::size_t i = 0; i < 8; ++i) {
            std::size_t const dx = i & 1, dy = i >> 1 & 1, dz = i >> 2;
            double const weight = (dx ? x.fraction : 1 - x.fraction) * (dy ? y.fraction : 1 - y.fraction) *
                                  (dz ? z.fraction : 1 - z.fraction);
            sum += weight * node_[((k * sides + y.first + dy) * sides + x.first + dx) * heights + z.first + dz];
        }
        return sum;
    }

  private:
    static constexpr std::size_t sides = 17, heights = 33;
    struct Cell {
        std::size_t first;
        double fraction;
    };
    static Cell cell(double at, std::size_t count) {
        double const inside = std::clamp(at, 0.0, static_cast<double>(count - 1));
        auto const first = std::min(static_cast<std::size_t>(inside), count - 2);
        return {first, inside - static_cast<double>(first)};
    }

    // The largest component of a node: crowded at both ends, where the sigmoid's argument runs away, and not at them.
    static double component_at(double height) {
        constexpr double least = 1e-4;
        double const sine = std::sin(pi_double / 2 * height);
        return least + (1 - 2 * least) * sine * sine;
    }
    static double height_of(double component) {
        constexpr double least = 1e-4;
        double const s = std::clamp((component - least) / (1 - 2 * least), 0.0, 1.0);
        return std::asin(std::sqrt(s)) * 2 / pi_double;
    }

    // From the middle up and down, each fit starting from the one before.
    void fill(SigmoidFitter const& fitter, std::size_t column) {
        std::size_t const k = column / (sides * sides), y = column / sides % sides, x = column % sides;
        auto const wanted = [&](std::size_t z) {
            Eigen::Vector3d rgb;
            rgb[static_cast<Eigen::Index>(k)] = 1;
            rgb[static_cast<Eigen::Index>((k + 1) % 3)] = static_cast<double>(x) / (sides - 1);
            rgb[static_cast<Eigen::Index>((k + 2) % 3)] = static_cast<double>(y) / (sides - 1);
            return to_ratio_(component_at(static_cast<double>(z) / (heights - 1)) * rgb);
        };
        Coefficients* const nodes = &node_[column * heights];
        constexpr std::size_t middle = heights / 2;
        nodes[middle] = coefficients_of(fitter.fit(wanted(middle)).sigmoid);
        for (std::size_t z = middle + 1; z < heights; ++z)
            nodes[z] = coefficients_of(fitter.fit(wanted(z), shape_of(nodes[z - 1]), node_effort).sigmoid);
        for (std::size_t z = middle; z-- > 0;)
            nodes[z] = coefficients_of(fitter.fit(wanted(z), shape_of(nodes[z + 1]), node_effort).sigmoid);
    }

    std::vector<Coefficients> node_;  // [k][y][x][z]
    ToRatio to_ratio_;
};

// Made once for each space, kept for the program's life.
struct Uplifter {
    explicit Uplifter(RgbSpace const& space)
        : to_ratio(space), fitter(white_light(space.white), cie1931_2deg()), table(space, fitter) {}
    ToRatio to_ratio;
    SigmoidFitter fitter;
    ReflectanceTable table;
};
Uplifter const& uplifter_of(RgbSpace const& space) {
    static std::map<std::string_view, Uplifter> made;
    static std::mutex guard;
    std::lock_guard const lock(guard);
    return made.try_emplace(space.name, space).first->second;
}

struct TexelFit {
    SigmoidShape sigmoid;
    double difference;
};

TexelFit fit_texel(Uplifter const& uplifter, Eigen::Array3f const& texel) {
    Eigen::Vector3d const rgb = texel.matrix().cast<double>();
    double const grey = rgb[1];
    if ((rgb.array() - grey).abs().maxCoeff() <= grey_rounding * std::abs(grey) && grey >= 0) {
        double const inside = std::clamp(grey, 0.0, 1.0), slope2 = inside * (1 - inside);
        double const c = slope2 > 0 ? (inside - 0.5) / std::sqrt(slope2) : (inside - 0.5) * 2 * steepest_argument;
        return {{0, 0, std::clamp(c, -steepest_argument, steepest_argument)}, 0};
    }
    VectorDouble const wanted = uplifter.to_ratio(rgb);
    SigmoidFit const fit = uplifter.fitter.fit(wanted, shape_of(uplifter.table.at(rgb)), texel_effort);
    if (fit.difference <= served) return {fit.sigmoid, fit.difference};
    SigmoidFit const slow = uplifter.fitter.fit(wanted);
    return slow.difference < fit.difference ? TexelFit{slow.sigmoid, slow.difference}
                                            : TexelFit{fit.sigmoid, fit.difference};
}

}  // namespace

UpliftedColours uplift_reflectances(std::span<Eigen::Array3f const> rgb, RgbSpace const& space) {
    Uplifter const& uplifter = uplifter_of(space);
    UpliftedColours result;
    result.sigmoid.resize(rgb.size());
    std::mutex guard;
    constexpr std::size_t grain = 1024;
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, rgb.size(), grain), [&](auto const& range) {
        std::size_t missed = 0;
        double worst = 0;
        TexelFit fit{};
        for (std::size_t i = range.begin(); i < range.end(); ++i) {
            // Pictures have plain areas.
            if (i == range.begin() || (rgb[i] != rgb[i - 1]).any()) fit = fit_texel(uplifter, rgb[i]);
            result.sigmoid[i] = {static_cast<float>(fit.sigmoid.a), static_cast<float>(fit.sigmoid.b),
                                 static_cast<float>(fit.sigmoid.c)};
            missed += fit.difference > unreachable;
            worst = std::max(worst, fit.difference);
        }
        std::lock_guard const lock(guard);
        result.unreachable += missed;
        result.worst_difference = std::max(result.worst_difference, worst);
    });
    return result;
}

}  // namespace iride
