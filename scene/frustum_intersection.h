// SPDX-License-Identifier: Apache-2.0
// Ray against the side of a cone's frustum, in double. With z along the axis (0 at `from`, h at `to`) and the radius
// r(z) = r0 + m z, m = (r1 - r0) / h, the side is x^2 + y^2 = r(z)^2: a quadratic in the ray parameter.
#pragma once

#include <optional>

#include "scene/shape.h"

namespace iride {

inline std::optional<float> intersect(Frustum const& f, Ray const& ray) {
    VectorDouble const axis = (f.to - f.from).cast<double>();
    double const h = axis.norm(), m = (static_cast<double>(f.top_radius) - f.radius) / h;
    VectorDouble const a = axis / h, d = ray.direction.cast<double>();
    VectorDouble const o = ray.origin.cast<double>() - f.from.cast<double>();
    double const oz = o.dot(a), dz = d.dot(a);
    VectorDouble const op = o - oz * a, dp = d - dz * a;  // across the axis
    double const r = f.radius + m * oz;                   // radius at the origin's height
    double const A = dp.squaredNorm() - square(m * dz), B = op.dot(dp) - r * m * dz, C = op.squaredNorm() - r * r;
    auto const accepted = [&](double t) {
        double const z = oz + t * dz;
        return t > ray.t_min && t < ray.t_max && z >= 0 && z <= h && f.radius + m * z >= 0;
    };
    if (A == 0) {  // parallel to a generator
        double const t = -C / (2 * B);
        return B != 0 && accepted(t) ? std::optional(static_cast<float>(t)) : std::nullopt;
    }
    double const discriminant = B * B - A * C;
    if (discriminant < 0) return std::nullopt;
    double const q = -(B + std::copysign(std::sqrt(discriminant), B));  // no cancellation
    double t0 = q / A, t1 = q != 0 ? C / q : t0;
    if (t0 > t1) std::swap(t0, t1);
    if (accepted(t0)) return static_cast<float>(t0);
    if (accepted(t1)) return static_cast<float>(t1);
    return std::nullopt;
}

struct PositionAndNormal {
    Vector position;
    Direction normal;
};

// The point of the side next to `near` at the same height, and the outward normal there.
inline PositionAndNormal project(Frustum const& f, Vector const& near) {
    VectorDouble const axis = (f.to - f.from).cast<double>();
    double const h = axis.norm(), m = (static_cast<double>(f.top_radius) - f.radius) / h;
    VectorDouble const a = axis / h, o = near.cast<double>() - f.from.cast<double>();
    double const z = std::clamp(o.dot(a), 0.0, h);
    VectorDouble const across = o - o.dot(a) * a;
    VectorDouble const outward = across.squaredNorm() > 0 ? VectorDouble(across.normalized()) : a.unitOrthogonal();
    VectorDouble const position = f.from.cast<double>() + z * a + (f.radius + m * z) * outward;
    return {position.cast<float>(), (outward - m * a).normalized().cast<float>()};
}

}  // namespace iride
