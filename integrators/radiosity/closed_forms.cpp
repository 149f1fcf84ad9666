// SPDX-License-Identifier: Apache-2.0
#include "integrators/radiosity/closed_forms.h"

#include <Eigen/Geometry>
#include <cmath>
#include <vector>

#include "base/constants.h"

namespace iride::radiosity {

double opposite_rectangles(double a, double b, double c) {
    double const X = a / c, Y = b / c, x = std::hypot(1, X), y = std::hypot(1, Y);
    double const logarithm = std::log(x * y / std::hypot(1, X, Y));
    return 2 / (pi_double * X * Y) *
           (logarithm + X * y * std::atan(X / y) + Y * x * std::atan(Y / x) - X * std::atan(X) - Y * std::atan(Y));
}

double adjacent_rectangles(double w, double h, double l) {
    double const W = w / l, H = h / l, W2 = W * W, H2 = H * H, both = W2 + H2, all = 1 + both, D = std::sqrt(both);
    double const logarithms = std::log((1 + W2) * (1 + H2) / all) + W2 * std::log(W2 * all / ((1 + W2) * both)) +
                              H2 * std::log(H2 * all / ((1 + H2) * both));
    return (W * std::atan(1 / W) + H * std::atan(1 / H) - D * std::atan(1 / D) + logarithms / 4) / (pi_double * W);
}

double coaxial_discs(double r, double s, double d) {
    double const R = r / d, S = s / d, X = 1 + (1 + S * S) / (R * R);
    // (X - sqrt(X^2 - 4 (S/R)^2)) / 2 without its cancellation.
    double const q = S / R;
    return 2 * q * q / (X + std::sqrt(X * X - 4 * q * q));
}

double patch_to_disc(double r, double d) { return r * r / (r * r + d * d); }
double patch_to_sphere(double cosine, double R, double d) { return cosine * R * R / (d * d); }
double inside_sphere(double A, double R) { return A / (4 * pi_double * R * R); }
double cap_to_itself(double theta) { return std::pow(std::sin(theta / 2), 2); }
double cone_to_itself(double r, double h) { return 1 - r / std::hypot(r, h); }

namespace {

// The part of a polygon (as directions from the patch) above the horizon.
std::vector<VectorDouble> above_horizon(VectorDouble const& from, VectorDouble const& normal,
                                        std::span<VectorDouble const> polygon) {
    std::vector<VectorDouble> kept;
    for (std::size_t k = 0; k < polygon.size(); ++k) {
        VectorDouble const a = polygon[k] - from, b = polygon[(k + 1) % polygon.size()] - from;
        double const height_a = normal.dot(a), height_b = normal.dot(b);
        if (height_a >= 0) kept.push_back(a);
        if ((height_a < 0) != (height_b < 0)) kept.push_back(a + (b - a) * (height_a / (height_a - height_b)));
    }
    return kept;
}

}  // namespace

double patch_to_polygon(VectorDouble const& from, VectorDouble const& normal, std::span<VectorDouble const> polygon) {
    std::vector<VectorDouble> const v = above_horizon(from, normal, polygon);
    double sum = 0;
    for (std::size_t k = 0; k < v.size(); ++k) {
        VectorDouble const &a = v[k], &b = v[(k + 1) % v.size()];
        VectorDouble const across = a.cross(b);
        double const sine = across.norm();
        if (sine > 0) sum += std::atan2(sine, a.dot(b)) * normal.dot(across) / sine;
    }
    return sum / (2 * pi_double);
}

}  // namespace iride::radiosity
