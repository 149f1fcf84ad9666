// SPDX-License-Identifier: Apache-2.0
#include "base/spherical.h"

#include <algorithm>

namespace iride {

SphericalRectangle::SphericalRectangle(Vector const& corner, Vector const& edge_x, Vector const& edge_y,
                                       Vector const& from) {
    float const width = edge_x.norm(), height = edge_y.norm();
    x_ = edge_x / width;
    y_ = edge_y / height;
    z_ = x_.cross(y_);
    Vector const d = corner - from;
    z0_ = d.dot(z_);
    if (z0_ > 0) z_ = -z_, z0_ = -z0_;
    x0_ = d.dot(x_);
    y0_ = d.dot(y_);
    x1_ = x0_ + width;
    y1_ = y0_ + height;
    // The planes through `from` and the four edges have normals (0, z0, -y0), (-z0, 0, x1), (0, -z0, y1), (z0, 0, -x0);
    // their z components, normalised, and the inner angles g0 .. g3 between neighbours.
    float const n0 = -y0_ / std::hypot(z0_, y0_), n1 = x1_ / std::hypot(z0_, x1_);
    float const n2 = y1_ / std::hypot(z0_, y1_), n3 = -x0_ / std::hypot(z0_, x0_);
    auto const angle = [](float a, float b) { return std::acos(std::clamp(-a * b, -1.0f, 1.0f)); };
    float const g0 = angle(n0, n1), g1 = angle(n1, n2), g2 = angle(n2, n3), g3 = angle(n3, n0);
    b0_ = n0;
    b1_ = n2;
    k_ = 2 * pi - g2 - g3;
    solid_angle_ = g0 + g1 - k_;
}

Vector SphericalRectangle::sample(Sample2 u) const {
    // u.x fixes the plane through the y axis that cuts off this share of the solid angle.
    float const au = u.x * solid_angle_ + k_;
    float const fu = (std::cos(au) * b0_ - b1_) / std::sin(au);
    float const cu = std::clamp(std::copysign(1 / std::sqrt(fu * fu + b0_ * b0_), fu), -1.0f, 1.0f);
    float const xu = std::clamp(-(cu * z0_) / std::sqrt(std::max(1e-12f, 1 - cu * cu)), x0_, x1_);
    // Along that plane, u.y is uniform in the height on the unit sphere.
    float const d2 = xu * xu + z0_ * z0_;
    float const h0 = y0_ / std::sqrt(d2 + y0_ * y0_), h1 = y1_ / std::sqrt(d2 + y1_ * y1_);
    float const hv = h0 + u.y * (h1 - h0), hv2 = hv * hv;
    float const yv = hv2 < 1 - 1e-6f ? hv * std::sqrt(d2) / std::sqrt(1 - hv2) : y1_;
    return xu * x_ + std::clamp(yv, y0_, y1_) * y_ + z0_ * z_;
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
    float const cos_b =
        divisor != 0 ? std::clamp(((q * t - p * s) * cos_alpha - q) / divisor, -1.0f, 1.0f) : 1.0f;
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
