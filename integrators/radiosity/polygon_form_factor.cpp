// SPDX-License-Identifier: Apache-2.0
#include "integrators/radiosity/polygon_form_factor.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "base/constants.h"

namespace iride::radiosity {

namespace {

// Nodes of the double exponential rule on (0, 1): distances from the nearer end, since those are what a singular end
// needs to full precision.
struct Node {
    double from_start, from_end, weight;
};
std::vector<Node> double_exponential_rule() {
    constexpr double step = 1.0 / 8, widest = 3.5;  // beyond, weights fall below 1e-20
    std::vector<Node> rule;
    for (double x = -widest; x <= widest; x += step) {
        double const y = pi_double / 2 * std::sinh(x), e = std::exp(-2 * std::abs(y));
        double const near = e / (1 + e), weight = step * pi_double * std::cosh(x) * near / (1 + e);
        rule.push_back(y < 0 ? Node{near, 1 / (1 + e), weight} : Node{1 / (1 + e), near, weight});
    }
    return rule;
}

// int_0^b ln sqrt((t - t0)^2 + d^2) dt.
double inner_integral(double t0, double d2, double b) {
    double const d = std::sqrt(d2);
    auto const primitive = [&](double x) {
        double const r2 = x * x + d2;
        double const logarithm = r2 > 0 ? x / 2 * std::log(r2) : 0;
        return logarithm - x + (d > 0 ? d * std::atan(x / d) : 0);
    };
    return primitive(b - t0) - primitive(-t0);
}

struct Edge {
    VectorDouble start, along;  // unit
    double length;
};

std::vector<Edge> edges_of(std::span<VectorDouble const> polygon) {
    std::vector<Edge> edges;
    for (std::size_t k = 0; k < polygon.size(); ++k) {
        VectorDouble const step = polygon[(k + 1) % polygon.size()] - polygon[k];
        double const length = step.norm();
        if (length > 0) edges.push_back({polygon[k], step / length, length});
    }
    return edges;
}

// int int ln |x - y| ds dt over two edges.
double logarithmic_integral(Edge const& e, Edge const& f) {
    static std::vector<Node> const rule = double_exponential_rule();
    double const cosine = e.along.dot(f.along);
    // Where the integrand bends sharply: opposite the ends of f, and where the lines come closest.
    VectorDouble const between = f.start - e.start;
    double const place = between.dot(e.along);
    std::vector<double> breaks{0, e.length, place, place + f.length * cosine};
    double const sine2 = 1 - cosine * cosine;
    if (sine2 > 1e-12) breaks.push_back((place - between.dot(f.along) * cosine) / sine2);
    for (double& s : breaks) s = std::clamp(s, 0.0, e.length);
    std::ranges::sort(breaks);
    double sum = 0;
    for (std::size_t k = 0; k + 1 < breaks.size(); ++k) {
        double const from = breaks[k], to = breaks[k + 1], width = to - from;
        if (!(width > 0)) continue;
        for (Node const& node : rule) {
            // From the nearer end, so that s is exact next to a break.
            double const s =
                node.from_start < node.from_end ? from + width * node.from_start : to - width * node.from_end;
            VectorDouble const v = e.start + s * e.along - f.start;
            double const t0 = v.dot(f.along);
            double const d2 = (v - t0 * f.along).squaredNorm();
            sum += width * node.weight * inner_integral(t0, d2, f.length);
        }
    }
    return sum;
}

// The part of a polygon before the plane through `origin`.
std::vector<VectorDouble> before_plane(std::span<VectorDouble const> polygon, VectorDouble const& origin,
                                       VectorDouble const& normal, double tolerance) {
    std::vector<VectorDouble> kept;
    for (std::size_t k = 0; k < polygon.size(); ++k) {
        VectorDouble const &a = polygon[k], &b = polygon[(k + 1) % polygon.size()];
        double const height_a = normal.dot(a - origin), height_b = normal.dot(b - origin);
        if (height_a >= -tolerance) kept.push_back(a);
        if ((height_a < -tolerance && height_b > tolerance) || (height_a > tolerance && height_b < -tolerance))
            kept.push_back(a + (b - a) * (height_a / (height_a - height_b)));
    }
    return kept;
}

bool is_somewhere_before(std::span<VectorDouble const> polygon, VectorDouble const& origin, VectorDouble const& normal,
                         double tolerance) {
    return std::ranges::any_of(polygon, [&](VectorDouble const& p) { return normal.dot(p - origin) > tolerance; });
}

}  // namespace

VectorDouble vector_area(std::span<VectorDouble const> polygon) {
    VectorDouble sum = VectorDouble::Zero();
    for (std::size_t k = 1; k + 1 < polygon.size(); ++k)
        sum += (polygon[k] - polygon[0]).cross(polygon[k + 1] - polygon[0]) / 2;
    return sum;
}

double exchange_area(std::span<VectorDouble const> first, std::span<VectorDouble const> second) {
    VectorDouble const area_1 = vector_area(first), area_2 = vector_area(second);
    double const size = std::sqrt(std::max(area_1.norm(), area_2.norm()));
    constexpr double rounding = 1e-12;  // of the size: a vertex this close to the other's plane lies in it
    VectorDouble const n1 = area_1.normalized(), n2 = area_2.normalized();
    if (!is_somewhere_before(second, first[0], n1, rounding * size) ||
        !is_somewhere_before(first, second[0], n2, rounding * size))
        return 0;
    std::vector<VectorDouble> const a = before_plane(first, second[0], n2, rounding * size),
                                    b = before_plane(second, first[0], n1, rounding * size);
    double sum = 0;
    std::vector<Edge> const edges_b = edges_of(b);
    for (Edge const& e : edges_of(a))
        for (Edge const& f : edges_b) {
            double const cosine = e.along.dot(f.along);
            if (std::abs(cosine) > 1e-15) sum += cosine * logarithmic_integral(e, f);
        }
    return std::max(0.0, sum / (2 * pi_double));
}

}  // namespace iride::radiosity
