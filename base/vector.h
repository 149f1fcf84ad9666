// SPDX-License-Identifier: Apache-2.0
// Vectors, rays and orthonormal frames. Lengths are metres; directions are unit vectors.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cmath>

#include "base/constants.h"

namespace iride {

using Vector = Eigen::Vector3f;
using Vector2 = Eigen::Vector2f;
using VectorDouble = Eigen::Vector3d;
using MatrixDouble = Eigen::Matrix3d;
using Transform = Eigen::Affine3d;

using Direction = Vector;  // unit length

struct Ray {
    Vector origin;
    Direction direction;
    float t_min = 0, t_max = infinity;  // metres along the ray
};

// v / |v|; of 0: 0. Inlined by order, like all that is done at every vertex of a path: left alone, GCC makes it calls.
[[gnu::always_inline]] inline Direction unit(Vector const& v) {
    float const length2 = v.squaredNorm();
    return length2 > 0 ? Direction(v / std::sqrt(length2)) : v;
}

inline float square(float x) { return x * x; }
inline double square(double x) { return x * x; }

// A right-handed orthonormal frame (tangent, bitangent, normal); local z is the normal.
struct Frame {
    Vector tangent, bitangent, normal;

    // Branchless basis around a unit normal, continuous except at n.z = 0. [Duff 2017]
    static Frame around(Direction const& n) {
        float const sign = std::copysign(1.0f, n.z());
        float const a = -1 / (sign + n.z());
        float const b = n.x() * n.y() * a;
        return {Vector(1 + sign * n.x() * n.x() * a, sign * b, -sign * n.x()),
                Vector(b, sign + n.y() * n.y() * a, -n.y()), n};
    }

    // Around n, with the tangent along what of t lies in the surface.
    static Frame along(Direction const& n, Vector const& t) {
        Vector const flat = t - n * n.dot(t);
        constexpr float parallel = 1e-4f;  // |flat| / |t| below which its direction is rounding
        if (!(flat.squaredNorm() > square(parallel) * t.squaredNorm())) return around(n);
        Direction const tangent = flat.normalized();
        return {tangent, n.cross(tangent), n};
    }
    Frame turned(Vector2 const& x) const {
        return {tangent * x.x() + bitangent * x.y(), bitangent * x.x() - tangent * x.y(), normal};
    }

    [[gnu::always_inline]] Vector to_local(Vector const& v) const {
        return {tangent.dot(v), bitangent.dot(v), normal.dot(v)};
    }
    [[gnu::always_inline]] Vector to_world(Vector const& v) const {
        return tangent * v.x() + bitangent * v.y() + normal * v.z();
    }
};

}  // namespace iride
