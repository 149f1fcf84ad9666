// SPDX-License-Identifier: Apache-2.0
// Uniform sampling of the solid angle of a rectangle and of a triangle: density 1 / solid angle on all of it.
#pragma once

#include <array>

#include "base/sampler.h"
#include "base/trigonometry.h"
#include "base/vector.h"

namespace iride {

// A rectangle in space: a corner and two edges at right angles.
struct Rectangle {
    Vector corner;
    Direction x, y, normal;  // along the edges; normal = x cross y
    float width, height;

    static Rectangle from_edges(Vector const& corner, Vector const& edge_x, Vector const& edge_y);
};

// A rectangle seen from a point (or from eight), in the frame (x, y, z) of the rectangle with z turned so that it lies
// at z0 < 0. The inner angles g of its spherical quadrilateral are kept as unit complex numbers e^(i g): sums of angles
// are products, and one arctangent is left, for the solid angle g0 + g1 + g2 + g3 - 2 pi itself. [Ureña 2013]
template <class Real>
class SphericalRectangle {
  public:
    // from: coordinates of the point, or of each of the points.
    SphericalRectangle(Rectangle const& rectangle, std::array<Real, 3> const& from);
    Real solid_angle() const { return solid_angle_; }
    // A point of the rectangle, relative to `from`.
    std::array<Real, 3> sample(Real u, Real v) const;

  private:
    struct Complex {
        Real re, im;
        friend Complex operator*(Complex a, Complex b) {
            return {a.re * b.re - a.im * b.im, a.re * b.im + a.im * b.re};
        }
    };

    Rectangle const& rectangle_;
    Real x0_, x1_, y0_, y1_, z0_, z_sign_;  // z_sign: of the frame's z against the rectangle's normal
    Real b0_, rest0_, b1_, solid_angle_;    // rest0 = 1 - b0^2
    Complex turn_;                          // e^(i k), k = 2 pi - g2 - g3
};

template <class Real>
SphericalRectangle<Real>::SphericalRectangle(Rectangle const& r, std::array<Real, 3> const& from) : rectangle_(r) {
    Real const dx = r.corner.x() - from[0], dy = r.corner.y() - from[1], dz = r.corner.z() - from[2], zero{};
    auto const along = [&](Direction const& a) { return dx * a.x() + dy * a.y() + dz * a.z(); };
    Real const side = along(r.normal);
    z0_ = -magnitude(side);
    z_sign_ = select(side > zero, zero - 1.0f, zero + 1.0f);
    x0_ = along(r.x);
    y0_ = along(r.y);
    x1_ = x0_ + r.width;
    y1_ = y0_ + r.height;
    // The planes through `from` and the four edges have normals (0, z0, -y0), (-z0, 0, x1), (0, -z0, y1), (z0, 0, -x0).
    // n: their z components, normalised; rest2 = 1 - n^2. Neither suffers from cancellation.
    std::array<Real, 4> const edge{-y0_, x1_, y1_, -x0_};
    std::array<Real, 4> n, rest2;
    Real const z2 = z0_ * z0_;
    for (std::size_t i = 0; i < 4; ++i) {
        Real const length2 = edge[i] * edge[i] + z2;
        n[i] = edge[i] / square_root(length2);
        rest2[i] = z2 / length2;
    }
    // e^(i g) of the inner angle between neighbouring planes, whose normals share no other component: cos g = -n n'.
    // The sine stays exact for a rectangle seen edge-on, where g comes near 0 or pi.
    auto const angle_after = [&](std::size_t i) {
        std::size_t const j = (i + 1) % 4;
        return Complex{-n[i] * n[j], square_root(rest2[i] + rest2[j] * (1 - rest2[i]))};
    };
    Complex const last = angle_after(2) * angle_after(3), all = angle_after(0) * angle_after(1) * last;
    turn_ = {last.re, -last.im};
    // The solid angle up to a whole turn. Rounding may leave a rectangle seen edge-on just below 0; one that fills all
    // but this much of a half-space then counts as 0 too, and is sampled by area like every small one.
    constexpr float rounding = 1e-4f;  // sr
    Real const angle = arctangent(all.im, all.re);
    solid_angle_ = select(angle < -rounding, angle + 2 * pi, larger(angle, zero));
    b0_ = n[0];
    rest0_ = rest2[0];
    b1_ = n[2];
}

template <class Real>
std::array<Real, 3> SphericalRectangle<Real>::sample(Real u, Real v) const {
    // u fixes the plane through the y axis that cuts off this share of the solid angle: it meets the rectangle at
    // x = cu |z0| / sqrt(1 - cu^2) with cu = +-1 / sqrt(fu^2 + b0^2), fu = a / sin: the divisions by sin cancel.
    auto const [sine, cosine] = sine_cosine_of_turns(u * solid_angle_ * (inverse_pi / 2));
    Complex const au = Complex{cosine, sine} * turn_;
    Real const a = au.re * b0_ - b1_, zero{};
    constexpr float least = 1e-30f;  // far beyond the edge, whither the clamp brings it back
    Real const across = square_root(larger(a * a - au.im * au.im * rest0_, zero + least));
    Real const xu = clamped(with_sign(au.im, a * au.im) * -z0_ / across, x0_, x1_);
    // Along that plane, v is uniform in the height on the unit sphere.
    Real const d2 = xu * xu + z0_ * z0_;
    Real const h0 = y0_ / square_root(d2 + y0_ * y0_), h1 = y1_ / square_root(d2 + y1_ * y1_);
    Real const hv = h0 + v * (h1 - h0), rest = 1 - hv * hv;
    constexpr float pole = 1e-6f;  // of the y axis, to which the rectangle then extends
    Real const yv = select(rest > zero + pole, hv * square_root(d2 / larger(rest, zero + pole)), y1_);
    Real const y = clamped(yv, y0_, y1_), z = z0_ * z_sign_;
    auto const coordinate = [&](int i) {
        return xu * rectangle_.x[i] + y * rectangle_.y[i] + z * rectangle_.normal[i];
    };
    return {coordinate(0), coordinate(1), coordinate(2)};
}

// Solid angle of a triangle with unit vectors a, b, c as corners: 2 atan2(|a . b x c|, 1 + ab + bc + ca), exact also
// for small ones. [Oosterom 1983]
float triangle_solid_angle(Direction const& a, Direction const& b, Direction const& c);

// A direction uniform in the spherical triangle a, b, c. [Arvo 1995]
Direction sample_spherical_triangle(Direction const& a, Direction const& b, Direction const& c, Sample2 u);

}  // namespace iride
