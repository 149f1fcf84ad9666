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
// other half, behind the tip, as well.
inline RayPart part_in_cone(Ray const& ray, Vector const& tip, Direction const& axis, float cosine) {
    Vector const o = ray.origin - tip;
    float const oa = o.dot(axis), da = ray.direction.dot(axis), c2 = square(cosine);
    RayPart const front = part_in_front(oa, da);
    if (cosine == 0 || front.empty()) return front;
    float const A = square(da) - c2, B = oa * da - c2 * o.dot(ray.direction), C = square(oa) - c2 * o.squaredNorm();
    float const discriminant = B * B - A * C;
    if (!(discriminant > 0)) return A < 0 ? no_part : front;  // past it, or through the tip
    float const q = -(B + std::copysign(std::sqrt(discriminant), B)), x = q / A, y = C / q;
    float const low = std::min(x, y), high = std::max(x, y);
    if (A < 0) return {std::max(front.from, low), std::min(front.to, high)};
    return da > 0 ? RayPart{std::max(front.from, high), front.to} : RayPart{front.from, std::min(front.to, low)};
}

}  // namespace iride
