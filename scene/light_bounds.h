// SPDX-License-Identifier: Apache-2.0
// What is known of a lamp, or of a group of them, without asking it: a box, a cone around all its normals, how far from
// a normal it emits, its strength. Its importance to a place bounds all this from there:
//   importance = I cos(theta') cos(theta_i') / d^2,   theta' = max(0, theta - theta_normals - theta_box)
// with theta from the cone's axis to the place, theta_i from the place's normal, theta_box what the box subtends; it is
// 0 only where no light can come from. [Conty 2018]
#pragma once

#include <array>
#include <limits>

#include "base/simd.h"
#include "base/vector.h"

namespace iride {

struct LightBounds {
    VectorDouble lower, upper;            // box
    VectorDouble axis{0, 0, 1};           // of the cone of normals
    double normals_rad = pi_double;       // its half angle
    double emission_rad = pi_double / 2;  // from a normal: no light beyond
    bool two_sided = false;
    double intensity = 0;  // largest luminous intensity, up to a common factor
};

LightBounds united(LightBounds const& a, LightBounds const& b);

// A place that light is chosen for. normal: 0 if light from either side counts, else of the side that does.
struct LightReceiver {
    Vector position{0, 0, 0};
    Vector normal{0, 0, 0};
};

namespace light_bounds_details {
// cos and sin of max(0, a - b) for angles in 0 .. pi.
template <class Real>
Real cos_of_rest(Real sin_a, Real cos_a, Real sin_b, Real cos_b) {
    return select(cos_a >= cos_b, Real{} + 1, cos_a * cos_b + sin_a * sin_b);
}
template <class Real>
Real sin_of_rest(Real sin_a, Real cos_a, Real sin_b, Real cos_b) {
    return select(cos_a >= cos_b, Real{}, sin_a * cos_b - cos_a * sin_b);
}
template <class Real>
Real sine_of(Real cosine) {
    return square_root(larger(Real{}, 1 - cosine * cosine));
}
}  // namespace light_bounds_details

// The same of eight groups, ready to be evaluated; those that are not there have intensity 0.
struct LightClusters {
    std::array<Real8, 3> centre{}, axis{};
    Real8 radius2{};  // of the sphere around the box
    Real8 cos_normals{}, sin_normals{}, cos_emission{}, intensity{};
    Real8 two_sided{};  // 1 or 0

    void set(int place, LightBounds const& bounds);
    Real8 importance(LightReceiver const& receiver) const;
};

inline Real8 LightClusters::importance(LightReceiver const& receiver) const {
    using namespace light_bounds_details;
    // Cosines that rounding may take below 0, or beyond the end of a lamp's cone, while light still comes.
    constexpr float rounding = 1e-3f;
    constexpr float nearest2 = 1e-12f;  // m^2: a place on a lamp without extent is a micrometre from it
    Vector const& p = receiver.position;
    std::array<Real8, 3> const d{p.x() - centre[0], p.y() - centre[1], p.z() - centre[2]};
    Real8 const distance2 = d[0] * d[0] + d[1] * d[1] + d[2] * d[2];
    Real8 const per_distance = 1 / square_root(larger(distance2, Real8{} + std::numeric_limits<float>::min()));
    auto const is_outside = distance2 > radius2;
    Real8 const sin_box_outside = smaller(square_root(radius2) * per_distance, Real8{} + 1);
    Real8 const sin_box = select(is_outside, sin_box_outside, Real8{});
    Real8 const cos_box = select(is_outside, sine_of(sin_box_outside), Real8{} - 1);
    Real8 const along = (d[0] * axis[0] + d[1] * axis[1] + d[2] * axis[2]) * per_distance;
    Real8 const cos_w = clamped(select(two_sided > 0, magnitude(along), along), Real8{} - 1, Real8{} + 1);
    Real8 const sin_w = sine_of(cos_w);
    Real8 const cos_x = cos_of_rest(sin_w, cos_w, sin_normals, cos_normals);
    Real8 const sin_x = sin_of_rest(sin_w, cos_w, sin_normals, cos_normals);
    Real8 const leaving = cos_of_rest(sin_x, cos_x, sin_box, cos_box);
    Real8 const farthest2 = larger(larger(distance2, radius2), Real8{} + nearest2);
    Real8 all = intensity * larger(leaving, Real8{} + rounding) / farthest2;
    all = select(leaving > cos_emission - rounding, all, Real8{});
    Vector const& n = receiver.normal;
    if (n == Vector(0, 0, 0)) return all;
    Real8 const cos_i = clamped(-(d[0] * n.x() + d[1] * n.y() + d[2] * n.z()) * per_distance, Real8{} - 1, Real8{} + 1);
    Real8 const arriving = cos_of_rest(sine_of(cos_i), cos_i, sin_box, cos_box);
    return select(arriving > -rounding, all * larger(arriving, Real8{} + rounding), Real8{});
}

}  // namespace iride
