// SPDX-License-Identifier: Apache-2.0
// Maps from the unit square to directions and points, each with its density. [Pharr 2023, appendix A.5]
#pragma once

#include <algorithm>

#include "base/quantity.h"
#include "base/sampler.h"
#include "base/trigonometry.h"
#include "base/vector.h"

namespace iride {

// Uniform on the unit disc, area preserving and continuous. Density 1/pi. [Shirley 1997]
inline Vector2 to_disc(Sample2 u) {
    float const x = 2 * u.x - 1, y = 2 * u.y - 1;
    if (x == 0 && y == 0) return {0, 0};
    // Which is the larger is as good as random: selected without a branch.
    bool const wide = std::abs(x) > std::abs(y);
    float const large = select(wide, x, y), small = select(wide, y, x);
    auto const [sine, cosine] = sine_cosine_of_octant(pi / 4 * (small / large));
    float const along = large * cosine, across = large * sine;
    return {select(wide, along, across), select(wide, across, along)};
}

// Cosine-weighted on the hemisphere z >= 0: a disc lifted up. Density cos / pi.
inline Direction to_cosine_hemisphere(Sample2 u) {
    Vector2 const d = to_disc(u);
    return {d.x(), d.y(), std::sqrt(std::max(0.0f, 1 - d.squaredNorm()))};
}
inline PerSteradian cosine_hemisphere_density(float cosine) {
    return PerSteradian(std::max(0.0f, cosine) * inverse_pi);
}

// Uniform on the whole sphere. Density 1 / (4 pi).
inline Direction to_sphere(Sample2 u) {
    float const z = 1 - 2 * u.x, r = std::sqrt(std::max(0.0f, 1 - z * z));
    auto const [sine, cosine] = sine_cosine_of_turns(u.y);
    return {r * cosine, r * sine, z};
}
inline constexpr PerSteradian uniform_sphere_density{inverse_pi / 4};

// Uniform in the cone of directions about +z with 1 - cos(half angle) = height. Density 1 / (2 pi height).
inline Direction to_cone(Sample2 u, float height) {
    float const below = u.x * height;  // 1 - cos(theta): exact for small cones, where cos rounds to 1
    float const r = std::sqrt(std::max(0.0f, below * (2 - below)));
    auto const [sine, cosine] = sine_cosine_of_turns(u.y);
    return {r * cosine, r * sine, 1 - below};
}
// That height from the squared sine of the half angle, without cancellation.
inline float cone_height(float sine2) { return sine2 / (1 + std::sqrt(std::max(0.0f, 1 - sine2))); }
inline PerSteradian cone_density(float height) { return PerSteradian(1 / (2 * pi * height)); }

// Barycentric coordinates, uniform on a triangle. Density 1 / area. [Heitz 2019, low distortion]
inline Vector2 to_triangle(Sample2 u) {
    if (u.x < u.y) {
        float const half = u.x / 2;
        return {half, u.y - half};
    }
    float const half = u.y / 2;
    return {u.x - half, half};
}

}  // namespace iride
