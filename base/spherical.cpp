// SPDX-License-Identifier: Apache-2.0
#include "base/spherical.h"

#include <algorithm>

namespace iride {

Rectangle Rectangle::from_edges(Vector const& corner, Vector const& edge_x, Vector const& edge_y) {
    Direction const x = edge_x.normalized(), y = edge_y.normalized();
    return {corner, x, y, x.cross(y), edge_x.norm(), edge_y.norm()};
}

float triangle_solid_angle(Direction const& a, Direction const& b, Direction const& c) {
    float const volume = std::abs(a.dot(b.cross(c)));
    return 2 * std::atan2(volume, 1 + a.dot(b) + b.dot(c) + c.dot(a));
}

Direction sample_spherical_triangle(Direction const& a, Direction const& b, Direction const& c, Sample2 u) {
    // Inner angles at a and b from the normals of the planes through the edges.
    Vector const nab = a.cross(b), nca = c.cross(a);
    float const cos_alpha = std::clamp(-nab.normalized().dot(nca.normalized()), -1.0f, 1.0f);
    float const alpha = std::acos(cos_alpha), sin_alpha = std::sin(alpha);
    float const area = triangle_solid_angle(a, b, c) * u.x;
    // The point c' on the edge a c for which the triangle a b c' has the wanted area.
    float const s = std::sin(area - alpha), t = std::cos(area - alpha), cos_c = a.dot(b);
    float const p = t - cos_alpha, q = s + sin_alpha * cos_c;
    float const divisor = (q * s + p * t) * sin_alpha;
    float const cos_b = divisor != 0 ? std::clamp(((q * t - p * s) * cos_alpha - q) / divisor, -1.0f, 1.0f) : 1.0f;
    Vector const across = (c - c.dot(a) * a).normalized();
    Direction const c_prime = cos_b * a + std::sqrt(std::max(0.0f, 1 - cos_b * cos_b)) * across;
    // Uniform in height along the arc from b to c'.
    float const cosine = 1 - u.y * (1 - c_prime.dot(b));
    Vector const away = c_prime - c_prime.dot(b) * b;
    float const length = away.norm();
    if (length == 0) return b;
    return (cosine * b + std::sqrt(std::max(0.0f, 1 - cosine * cosine)) * (away / length)).normalized();
}

}  // namespace iride
