// SPDX-License-Identifier: Apache-2.0
#include "scene/shape.h"

namespace iride {

bool Quad::is_rectangle() const {
    constexpr float tolerance = 1e-5f;  // relative; a larger departure would shift samples visibly
    Vector const a = corner[1] - corner[0], b = corner[3] - corner[0], c = corner[2] - corner[0];
    return std::abs(a.dot(b)) <= tolerance * a.norm() * b.norm() && (a + b - c).norm() <= tolerance * c.norm();
}

float Frustum::area() const {
    float const slant = std::sqrt(square(length()) + square(radius - top_radius));
    return pi * (radius + top_radius) * slant;
}

}  // namespace iride
