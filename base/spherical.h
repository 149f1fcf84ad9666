// SPDX-License-Identifier: Apache-2.0
// Uniform sampling of the solid angle of a rectangle and of a triangle: density 1 / solid angle on all of it.
#pragma once

#include <complex>

#include "base/sampler.h"
#include "base/vector.h"

namespace iride {

// A rectangle in space: a corner and two edges at right angles.
struct Rectangle {
    Vector corner;
    Direction x, y, normal;  // along the edges; normal = x cross y
    float width, height;

    static Rectangle from_edges(Vector const& corner, Vector const& edge_x, Vector const& edge_y);
};

// A rectangle seen from a point, in the frame (x, y, z) of the rectangle with z turned so that it lies at z0 < 0.
// The inner angles g of its spherical quadrilateral are kept as unit complex numbers e^(i g): sums of angles are
// products, and one arctangent is left, for the solid angle g0 + g1 + g2 + g3 - 2 pi itself. [Ureña 2013]
class SphericalRectangle {
  public:
    SphericalRectangle(Rectangle const& rectangle, Vector const& from);
    float solid_angle() const { return solid_angle_; }
    // A point of the rectangle, relative to `from`.
    Vector sample(Sample2 u) const;

  private:
    Rectangle const& rectangle_;
    float x0_, x1_, y0_, y1_, z0_, z_sign_;  // z_sign: of the frame's z against the rectangle's normal
    float b0_, rest0_, b1_, solid_angle_;    // rest0 = 1 - b0^2
    std::complex<float> turn_;               // e^(i k), k = 2 pi - g2 - g3
};

// Solid angle of a triangle with unit vectors a, b, c as corners: 2 atan2(|a . b x c|, 1 + ab + bc + ca), exact also
// for small ones. [Oosterom 1983]
float triangle_solid_angle(Direction const& a, Direction const& b, Direction const& c);

// A direction uniform in the spherical triangle a, b, c. [Arvo 1995]
Direction sample_spherical_triangle(Direction const& a, Direction const& b, Direction const& c, Sample2 u);

}  // namespace iride
