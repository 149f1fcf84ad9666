// SPDX-License-Identifier: Apache-2.0
#include "base/spherical.h"

#include <algorithm>
#include <cstdint>

#include "base/trigonometry.h"

namespace iride {

Rectangle Rectangle::from_edges(Vector const& corner, Vector const& edge_x, Vector const& edge_y) {
    Direction const x = edge_x.normalized(), y = edge_y.normalized();
    return {corner, x, y, x.cross(y), edge_x.norm(), edge_y.norm()};
}

namespace {

using Complex = std::complex<float>;
using Four = float __attribute__((vector_size(4 * sizeof(float))));
using FourWords = std::int32_t __attribute__((vector_size(4 * sizeof(std::int32_t))));

// The product without the library's care for infinities, which cannot occur between unit numbers.
Complex product(Complex a, Complex b) {
    return {a.real() * b.real() - a.imag() * b.imag(), a.real() * b.imag() + a.imag() * b.real()};
}

Four square_root(Four a) {
    for (int i = 0; i < 4; ++i) a[i] = std::sqrt(a[i]);
    return a;
}

}  // namespace

SphericalRectangle::SphericalRectangle(Rectangle const& r, Vector const& from) : rectangle_(r) {
    Vector const d = r.corner - from;
    float const side = d.dot(r.normal);
    z0_ = -std::abs(side);
    z_sign_ = side > 0 ? -1.0f : 1.0f;
    x0_ = d.dot(r.x);
    y0_ = d.dot(r.y);
    x1_ = x0_ + r.width;
    y1_ = y0_ + r.height;
    // The planes through `from` and the four edges have normals (0, z0, -y0), (-z0, 0, x1), (0, -z0, y1), (z0, 0, -x0).
    // n: their z components, normalised; rest2 = 1 - n^2. Neither suffers from cancellation.
    Four const edge{-y0_, x1_, y1_, -x0_};
    float const z2 = z0_ * z0_;
    Four const length2 = edge * edge + z2;
    Four const n = edge / square_root(length2), rest2 = z2 / length2;
    // e^(i g) of the inner angles between neighbouring planes, whose normals share no other component: cos g = -n n'.
    // The sine stays exact for a rectangle seen edge-on, where g comes near 0 or pi.
    constexpr FourWords next{1, 2, 3, 0};
    Four const n_next = __builtin_shuffle(n, next), rest2_next = __builtin_shuffle(rest2, next);
    Four const cosine = -n * n_next, sine = square_root(rest2 + rest2_next * (1 - rest2));
    auto const angle_after = [&](int i) { return Complex(cosine[i], sine[i]); };
    turn_ = std::conj(product(angle_after(2), angle_after(3)));
    Complex const all = product(product(angle_after(0), angle_after(1)), std::conj(turn_));
    // The solid angle up to a whole turn. Rounding may leave a rectangle seen edge-on just below 0; one that fills all
    // but this much of a half-space then counts as 0 too, and is sampled by area like every small one.
    constexpr float rounding = 1e-4f;  // sr
    float const angle = arctangent(all.imag(), all.real());
    solid_angle_ = angle < -rounding ? angle + 2 * pi : std::max(angle, 0.0f);
    b0_ = n[0];
    rest0_ = rest2[0];
    b1_ = n[2];
}

Vector SphericalRectangle::sample(Sample2 u) const {
    // u.x fixes the plane through the y axis that cuts off this share of the solid angle: it meets the rectangle at
    // x = cu |z0| / sqrt(1 - cu^2) with cu = +-1 / sqrt(fu^2 + b0^2), fu = a / sin: the divisions by sin cancel.
    auto const [sine, cosine] = sine_cosine_of_turns(u.x * solid_angle_ * (inverse_pi / 2));
    Complex const au = product({cosine, sine}, turn_);
    float const a = au.real() * b0_ - b1_;
    constexpr float least = 1e-30f;  // far beyond the edge, whither the clamp brings it back
    float const xu = std::clamp(std::copysign(au.imag(), a * au.imag()) * -z0_ /
                                    std::sqrt(std::max(least, a * a - au.imag() * au.imag() * rest0_)),
                                x0_, x1_);
    // Along that plane, u.y is uniform in the height on the unit sphere.
    float const d2 = xu * xu + z0_ * z0_;
    float const h0 = y0_ / std::sqrt(d2 + y0_ * y0_), h1 = y1_ / std::sqrt(d2 + y1_ * y1_);
    float const hv = h0 + u.y * (h1 - h0), hv2 = hv * hv;
    float const yv = hv2 < 1 - 1e-6f ? hv * std::sqrt(d2 / (1 - hv2)) : y1_;
    return xu * rectangle_.x + std::clamp(yv, y0_, y1_) * rectangle_.y + (z0_ * z_sign_) * rectangle_.normal;
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
