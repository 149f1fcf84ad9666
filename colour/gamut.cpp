// SPDX-License-Identifier: Apache-2.0
#include "colour/gamut.h"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <vector>

#include "base/diagnostics.h"
#include "colour/difference.h"
#include "colour/lch.h"

namespace iride {

namespace {

// Smallest value of a convex function on [low, high], by golden sections.
template <class Function>
double smallest(double low, double high, Function const& f) {
    constexpr double golden = 0.6180339887498949;  // (sqrt(5) - 1) / 2
    constexpr int steps = 45;                      // leave golden^45 = 4e-10 of the interval
    double a = high - golden * (high - low), b = low + golden * (high - low), f_a = f(a), f_b = f(b);
    for (int i = 0; i < steps; ++i) {
        if (f_a < f_b) {
            high = b, b = a, f_b = f_a;
            f_a = f(a = high - golden * (high - low));
        } else {
            low = a, a = b, f_a = f_b;
            f_b = f(b = low + golden * (high - low));
        }
    }
    return std::min(f_a, f_b);
}

}  // namespace

bool is_light(Xyz const& c, SpectralLocus const& locus) {
    if (c.X == 0 && c.Y == 0 && c.Z == 0) return true;
    return c.Y > 0 && locus.contains(to_chromaticity(c));
}

Xyz optimal_colour(double from_nm, double to_nm, TristimulusWeights const& weights) {
    Xyz sum;
    for (std::size_t i = 0; i < weights.weights().size(); ++i) {
        double const nm = weights.wavelengths_nm()[i];
        bool const between = std::min(from_nm, to_nm) <= nm && nm <= std::max(from_nm, to_nm);
        if (between == (from_nm <= to_nm)) sum = sum + weights.weights()[i];
    }
    return sum;
}

bool is_object_colour(Xyz const& colour, TristimulusWeights const& weights) {
    constexpr double tolerance = 1e-6;
    VectorDouble const white = to_vector(weights.white());
    VectorDouble const p = to_vector(colour).cwiseQuotient(white) - VectorDouble::Constant(.5);
    if (!p.allFinite()) return false;
    if (p.norm() <= tolerance) return true;
    std::vector<VectorDouble> relative;
    for (Xyz const& w : weights.weights()) relative.push_back(to_vector(w).cwiseQuotient(white));
    auto const support = [&](VectorDouble const& d) {
        double sum = 0;
        for (VectorDouble const& w : relative) sum += std::abs(d.dot(w));
        return sum / 2;
    };
    // d = p / p^2 + s e1 + t e2. The solid holds a ball of radius 1/50 of the white about its middle, and is held by
    // one of radius 1, which bounds s and t.
    VectorDouble const along = p / p.squaredNorm(), e1 = p.unitOrthogonal(), e2 = p.normalized().cross(e1);
    double const reach = 50 / p.norm();
    double const least = smallest(-reach, reach, [&](double s) {
        return smallest(-reach, reach, [&](double t) { return support(along + s * e1 + t * e2); });
    });
    return least >= 1 - tolerance;
}

RgbGamut::RgbGamut(MatrixDouble const& rgb_to_xyz) : to_xyz_(rgb_to_xyz), from_xyz_(rgb_to_xyz.inverse()) {
    if (!from_xyz_.allFinite()) throw InputError({}, "", "the matrix of the gamut is singular");
}

bool RgbGamut::contains(Xyz const& colour) const {
    constexpr double rounding = 1e-9;
    VectorDouble const rgb = from_xyz_ * to_vector(colour);
    return rgb.minCoeff() >= -rounding && rgb.maxCoeff() <= 1 + rounding;
}

Xyz RgbGamut::nearest_by_chroma(Xyz const& colour, Xyz const& white) const {
    if (contains(colour)) return colour;
    Lab const lab = to_lab(colour, white), brightest = to_lab(at(VectorDouble::Ones()), white);
    double const L = std::clamp(lab.L, 0.0, brightest.L);
    // Towards the grey of this gamut, whose hue need not be that of `white`: the axis from black to its own white.
    Lab const grey = to_lab(relative_luminance(L) / relative_luminance(brightest.L) * at(VectorDouble::Ones()), white);
    double inside = 0, outside = 1;
    auto const on_the_way = [&](double t) {
        return to_xyz(Lab{L, grey.a + t * (lab.a - grey.a), grey.b + t * (lab.b - grey.b)}, white);
    };
    for (int i = 0; i < 60; ++i) {
        double const middle = (inside + outside) / 2;
        (contains(on_the_way(middle)) ? inside : outside) = middle;
    }
    return on_the_way(inside);
}

Xyz RgbGamut::nearest_by_difference(Xyz const& colour, Xyz const& white) const {
    if (contains(colour)) return colour;
    Lab const wanted = to_lab(colour, white);
    auto const distance = [&](VectorDouble const& rgb) { return delta_e_1976(to_lab(at(rgb), white), wanted); };
    VectorDouble best = (from_xyz_ * to_vector(colour)).cwiseMax(0).cwiseMin(1);
    double least = distance(best);
    auto const attempt = [&](VectorDouble const& candidate) {
        VectorDouble const rgb = candidate.cwiseMax(0).cwiseMin(1);
        double const value = distance(rgb);
        if (!(value < least)) return false;
        least = value;
        best = rgb;
        return true;
    };
    // A coarse look at the whole cube, denser towards black where L*a*b* is; then a shrinking search around the best.
    constexpr int grid = 12;
    auto const node = [](int i) { return std::pow(static_cast<double>(i) / grid, 3); };
    for (int r = 0; r <= grid; ++r)
        for (int g = 0; g <= grid; ++g)
            for (int b = 0; b <= grid; ++b) attempt({node(r), node(g), node(b)});
    for (double step = .25; step > 1e-9;) {
        bool better = false;
        for (int r = -1; r <= 1; ++r)
            for (int g = -1; g <= 1; ++g)
                for (int b = -1; b <= 1; ++b)
                    if (r != 0 || g != 0 || b != 0) better |= attempt(best + step * VectorDouble(r, g, b));
        if (!better) step /= 2;
    }
    return at(best);
}

}  // namespace iride
