// SPDX-License-Identifier: Apache-2.0
// What is known of a lamp, or of a group of them, without asking it: a box, a cone around all its normals, how far from
// a normal it emits, its strength. Its importance to a place bounds all this from there:
//   importance = I cos(theta') cos(theta_i') / d^2,   theta' = max(0, theta - theta_normals - theta_box)
// with theta from the cone's axis to the place, theta_i from the place's normal, theta_box what the box subtends; it is
// 0 only where no light can come from. [Conty 2018]
#pragma once

#include <algorithm>

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

// The same, ready to be evaluated.
struct LightCluster {
    Vector centre, axis;
    float radius2;  // of the sphere around the box
    float cos_normals, sin_normals, cos_emission, intensity;
    bool two_sided;

    explicit LightCluster(LightBounds const& bounds);
    float importance(LightReceiver const& receiver) const;
};

namespace light_bounds_details {
// cos and sin of max(0, a - b) for angles in 0 .. pi.
inline float cos_of_rest(float sin_a, float cos_a, float sin_b, float cos_b) {
    return cos_a >= cos_b ? 1 : cos_a * cos_b + sin_a * sin_b;
}
inline float sin_of_rest(float sin_a, float cos_a, float sin_b, float cos_b) {
    return cos_a >= cos_b ? 0 : sin_a * cos_b - cos_a * sin_b;
}
inline float sine_of(float cosine) { return std::sqrt(std::max(0.0f, 1 - cosine * cosine)); }
}  // namespace light_bounds_details

inline float LightCluster::importance(LightReceiver const& receiver) const {
    using namespace light_bounds_details;
    // Cosines that rounding may take below 0, or beyond the end of a lamp's cone, while light still comes.
    constexpr float rounding = 1e-3f;
    constexpr float nearest2 = 1e-12f;  // m^2: a place on a lamp without extent is a micrometre from it
    Vector const d = receiver.position - centre;
    float const distance2 = d.squaredNorm();
    float cos_box = -1, sin_box = 0;
    if (distance2 > radius2) {
        float const sin2 = radius2 / distance2;
        sin_box = std::sqrt(sin2);
        cos_box = std::sqrt(1 - sin2);
    }
    Direction const w = distance2 > 0 ? Vector(d / std::sqrt(distance2)) : axis;
    float const along = two_sided ? std::abs(w.dot(axis)) : w.dot(axis);
    float const cos_w = std::clamp(along, -1.0f, 1.0f), sin_w = sine_of(cos_w);
    float const cos_x = cos_of_rest(sin_w, cos_w, sin_normals, cos_normals);
    float const sin_x = sin_of_rest(sin_w, cos_w, sin_normals, cos_normals);
    float const leaving = cos_of_rest(sin_x, cos_x, sin_box, cos_box);
    if (leaving <= cos_emission - rounding) return 0;
    float all = intensity * std::max(leaving, rounding) / std::max({distance2, radius2, nearest2});
    if (receiver.normal != Vector(0, 0, 0)) {
        float const cos_i = std::clamp(-w.dot(receiver.normal), -1.0f, 1.0f);
        float const arriving = cos_of_rest(sine_of(cos_i), cos_i, sin_box, cos_box);
        if (arriving <= -rounding) return 0;
        all *= std::max(arriving, rounding);
    }
    return all;
}

}  // namespace iride
