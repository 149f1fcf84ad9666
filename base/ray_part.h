// SPDX-License-Identifier: Apache-2.0
// Parts of a ray [m]: what of it lies before a plane, or in a cone.
#pragma once

#include <algorithm>
#include <cmath>

#include "base/vector.h"

namespace iride {

struct RayPart {
    float from = 0, to = infinity;

    bool empty() const { return !(from < to); }
    RayPart before(float end) const { return {from, std::min(to, end)}; }
};

inline constexpr RayPart no_part{0, 0};

// Where a + b t >= 0, t >= 0.
inline RayPart part_in_front(float a, float b) {
    if (b == 0) return a < 0 ? no_part : RayPart{};
    float const t = -a / b;
    return b > 0 ? RayPart{std::max(0.0f, t), infinity} : RayPart{0, std::max(0.0f, t)};
}

// What lies in the cone with its tip at `tip` about `axis`, cosine >= 0 being that of its half angle: v.axis >= c |v|.
// It is convex, so this is one part, between roots of A t^2 + 2 B t + C = (v.axis)^2 - c^2 v^2, which has the cone's
// other half, behind the tip, as well. t counts from the foot of the perpendicular h from the tip, which keeps the
// digits of far rays; B^2 - A C = c^2 ((h.axis)^2 + A h^2).
inline RayPart part_in_cone(Ray const& ray, Vector const& tip, Direction const& axis, float cosine) {
    Vector const o = ray.origin - tip;
    float const foot = -o.dot(ray.direction), da = ray.direction.dot(axis), c2 = square(cosine);
    Vector const h = o + foot * ray.direction;
    RayPart const front = part_in_front(o.dot(axis), da);
    float const ha = h.dot(axis), h2 = h.squaredNorm(), A = square(da) - c2, B = ha * da, C = square(ha) - c2 * h2;
    float const discriminant = c2 * (square(ha) + A * h2);
    if (!(discriminant > 0))
        return A < 0 ? no_part : front;  // past it; or through the tip, or the cone is a half space
    float const q = -(B + std::copysign(std::sqrt(discriminant), B)), x = q / A, y = C / q;
    float const low = foot + std::min(x, y), high = foot + std::max(x, y);
    if (A < 0) return {std::max(front.from, low), std::min(front.to, high)};
    return da > 0 ? RayPart{std::max(front.from, high), front.to} : RayPart{front.from, std::min(front.to, low)};
}

}  // namespace iride
