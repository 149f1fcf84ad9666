// SPDX-License-Identifier: Apache-2.0
#include "integrators/photon/disc_area.h"

#include <algorithm>
#include <cmath>

namespace iride {

namespace {

// Signed area of the part of the disc about the origin that lies in the triangle (0, a, b): outside the disc a sector,
// inside a triangle.
double disc_area_in_triangle(Eigen::Vector2d const& a, Eigen::Vector2d const& b, double r) {
    auto const cross = [](Eigen::Vector2d const& p, Eigen::Vector2d const& q) { return p.x() * q.y() - p.y() * q.x(); };
    auto const sector = [&](Eigen::Vector2d const& p, Eigen::Vector2d const& q) {
        return 0.5 * r * r * std::atan2(cross(p, q), p.dot(q));
    };
    Eigen::Vector2d const d = b - a;
    double const A = d.squaredNorm(), B = a.dot(d), C = a.squaredNorm() - r * r, discriminant = B * B - A * C;
    if (!(discriminant > 0)) return sector(a, b);
    double const root = std::sqrt(discriminant);
    double const enter = std::clamp((-B - root) / A, 0.0, 1.0), leave = std::clamp((-B + root) / A, 0.0, 1.0);
    if (!(enter < leave)) return sector(a, b);
    Eigen::Vector2d const p = a + enter * d, q = a + leave * d;
    return (enter > 0 ? sector(a, p) : 0) + 0.5 * cross(p, q) + (leave < 1 ? sector(q, b) : 0);
}

}  // namespace

double disc_area_in_polygon(std::span<Eigen::Vector2d const> corner, Eigen::Vector2d const& centre, double radius) {
    double area = 0;
    for (std::size_t i = 0; i < corner.size(); ++i)
        area += disc_area_in_triangle(corner[i] - centre, corner[(i + 1) % corner.size()] - centre, radius);
    return area;
}

}  // namespace iride
