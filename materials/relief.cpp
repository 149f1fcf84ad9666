// SPDX-License-Identifier: Apache-2.0
#include "materials/relief.h"

namespace iride {

Direction BumpMap::normal_at(SurfacePoint const& point) const {
    Vector2 const slope = height_m_ * height_.gradient(point);
    Vector const &pu = point.dp_du, &pv = point.dp_dv;
    float const E = pu.squaredNorm(), F = pu.dot(pv), G = pv.squaredNorm(), determinant = E * G - F * F;
    if (!(determinant > 0)) return point.normal;
    Vector const uphill = ((G * slope.x() - F * slope.y()) * pu + (E * slope.y() - F * slope.x()) * pv) / determinant;
    return (point.normal - (uphill - point.normal * point.normal.dot(uphill))).normalized();
}

Direction NormalMap::normal_at(SurfacePoint const& point) const {
    Eigen::Array3f sum = Eigen::Array3f::Zero();
    picture_->visit_texels(point, mapping_, [&](Eigen::Array3f const& texel, float weight) { sum += weight * texel; });
    constexpr float least_z = 0.01f;  // a normal that looks into the surface is as good as grazing
    Direction const &n = point.normal, &t = point.tangent;
    Direction b = n.cross(t);
    if (b.dot(point.dp_dv) < 0) b = -b;
    return (sum.x() * t + sum.y() * b + std::max(sum.z(), least_z) * n).normalized();
}

}  // namespace iride
