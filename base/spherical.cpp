// SPDX-License-Identifier: Apache-2.0
#include "base/spherical.h"

#include <algorithm>

namespace iride {

Rectangle Rectangle::from_edges(Vector const& corner, Vector const& edge_x, Vector const& edge_y) {
    Direction const x = edge_x.normalized(), y = edge_y.normalized();
    return {corner, x, y, x.cross(y), edge_x.norm(), edge_y.norm()};
}

namespace {

using Complex = std::complex<float>;

// The product without the library's care for infinities, which cannot occur between unit numbers.
Complex product(Complex a, Complex b) {
    return {a.real() * b.real() - a.imag() * b.imag(), a.real() * b.imag() + a.imag() * b.real()};
}

// The z component n of a plane's unit normal, and 1 - n^2, each without cancellation.
struct PlaneNormal {
    float n, rest2;
    PlaneNormal(float side, float z0) {
        float const length2 = side * side + z0 * z0;
        n = side / std::sqrt(length2);
        rest2 = z0 * z0 / length2;
    }
};

// e^(i g) of the inner angle between neighbouring planes, whose normals share no other component: cos g = -a b. The
// sine stays exact for a rectangle seen edge-on, where g comes near 0 or pi.
Complex inner_angle(PlaneNormal const& a, PlaneNormal const& b) {
    return {-a.n * b.n, std::sqrt(a.rest2 + b.rest2 * (1 - a.rest2))};
}

}  // namespace

SphericalRectangle::SphericalRectangle(Rectangle const& r, Vector const& from) : rectangle_(r), z_(r.normal) {
    Vector const d = r.corner - from;
    z0_ = d.dot(z_);
    if (z0_ > 0) z_ = -z_, z0_ = -z0_;
    x0_ = d.dot(r.x);
    y0_ = d.dot(r.y);
    x1_ = x0_ + r.width;
    y1_ = y0_ + r.height;
    // The planes through `from` and the four edges have normals (0, z0, -y0), (-z0, 0, x1), (0, -z0, y1), (z0, 0, -x0);
    // their z components, normalised, and the inner angles between neighbours.
    PlaneNormal const n0(-y0_, z0_), n1(x1_, z0_), n2(y1_, z0_), n3(-x0_, z0_);
    Complex const g01 = product(inner_angle(n0, n1), inner_angle(n3, n0));
    Complex const g23 = product(inner_angle(n1, n2), inner_angle(n2, n3));
    Complex const all = product(g01, g23);
    // The solid angle up to a whole turn. Rounding may leave a rectangle seen edge-on just below 0; one that fills all
    // but this much of a half-space then counts as 0 too, and is sampled by area like every small one.
    constexpr float rounding = 1e-4f;  // sr
    float const angle = std::atan2(all.imag(), all.real());
    solid_angle_ = angle < -rounding ? angle + 2 * pi : std::max(angle, 0.0f);
    b0_ = n0.n;
    b1_ = n2.n;
    turn_ = std::conj(product(inner_angle(n2, n3), inner_angle(n3, n0)));
}

Vector SphericalRectangle::sample(Sample2 u) const {
    // u.x fixes the plane through the y axis that cuts off this share of the solid angle.
    float const part = u.x * solid_angle_;
    Complex const au = product({std::cos(part), std::sin(part)}, turn_);
    float const fu = (au.real() * b0_ - b1_) / au.imag();
    float const cu = std::clamp(std::copysign(1 / std::sqrt(fu * fu + b0_ * b0_), fu), -1.0f, 1.0f);
    float const xu = std::clamp(-(cu * z0_) / std::sqrt(std::max(1e-12f, 1 - cu * cu)), x0_, x1_);
    // Along that plane, u.y is uniform in the height on the unit sphere.
    float const d2 = xu * xu + z0_ * z0_;
    float const h0 = y0_ / std::sqrt(d2 + y0_ * y0_), h1 = y1_ / std::sqrt(d2 + y1_ * y1_);
    float const hv = h0 + u.y * (h1 - h0), hv2 = hv * hv;
    float const yv = hv2 < 1 - 1e-6f ? hv * std::sqrt(d2 / (1 - hv2)) : y1_;
    return xu * rectangle_.x + std::clamp(yv, y0_, y1_) * rectangle_.y + z0_ * z_;
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
