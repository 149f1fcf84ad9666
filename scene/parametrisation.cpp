// SPDX-License-Identifier: Apache-2.0
#include "scene/parametrisation.h"

namespace iride {

namespace {

// Directions across `axis`: `right` and `up` with right x up = axis, up as near to +y as it can be, or to -z.
struct Across {
    Direction right, up;
};
Across across_normal(Direction const& normal) {
    constexpr float nearly_y = 0.999f;  // cosine: nearer, what is left of y is no direction to trust
    Direction const wanted = std::abs(normal.y()) < nearly_y ? Direction(0, 1, 0) : Direction(0, 0, -1);
    Direction const right = wanted.cross(normal).normalized();
    return {right, normal.cross(right)};
}

void parametrise_shape(Sphere const& s, HitCoordinates const&, SurfacePoint& point) {
    Direction const n = point.geometric_normal;
    constexpr float least = 1e-4f;  // radius of a circle of latitude, of the sphere's: at a pole u has no direction
    float const r = std::hypot(n.x(), n.z());
    float const sine = r > 0 ? n.x() / r : 0, cosine = r > 0 ? n.z() / r : 1;
    point.uv = {0.5f + std::atan2(n.x(), n.z()) / (2 * pi), 0.5f + std::atan2(n.y(), r) / pi};
    point.dp_du = 2 * pi * s.radius * std::max(r, least) * Vector(cosine, 0, -sine);
    point.dp_dv = pi * s.radius * Vector(-n.y() * sine, r, -n.y() * cosine);
}

void parametrise_shape(Quad const& q, HitCoordinates const& hit, SurfacePoint& point) {
    // p = c0 + u a + v b + u v e. Gauss and Newton from Embree's coordinates, which are the answer if e = 0.
    auto const& c = q.corner;
    Vector const a = c[1] - c[0], b = c[3] - c[0], e = c[2] - c[1] - b;
    constexpr int rounds = 6;
    Vector2 uv(hit.u, hit.v);
    for (int round = 0;; ++round) {
        point.dp_du = a + uv.y() * e;
        point.dp_dv = b + uv.x() * e;
        if (round == rounds || e.squaredNorm() <= 1e-12f * a.squaredNorm()) break;
        Vector const rest = c[0] + uv.x() * a + uv.y() * point.dp_dv - point.position;
        float const E = point.dp_du.squaredNorm(), F = point.dp_du.dot(point.dp_dv), G = point.dp_dv.squaredNorm();
        float const determinant = E * G - F * F, x = point.dp_du.dot(rest), y = point.dp_dv.dot(rest);
        if (!(determinant > 0)) break;
        uv -= Vector2(G * x - F * y, E * y - F * x) / determinant;
    }
    point.uv = uv.cwiseMax(0.0f).cwiseMin(1.0f);
}

void parametrise_shape(Disc const& d, HitCoordinates const&, SurfacePoint& point) {
    auto const [right, up] = across_normal(d.normal);
    Vector const from_centre = point.position - d.centre;
    float const size = 2 * d.radius;
    point.uv = {0.5f + from_centre.dot(right) / size, 0.5f + from_centre.dot(up) / size};
    point.dp_du = size * right;
    point.dp_dv = size * up;
}

void parametrise_shape(Frustum const& f, HitCoordinates const&, SurfacePoint& point) {
    float const h = f.length();
    Direction const axis = (f.to - f.from) / h;
    constexpr float nearly_z = 0.999f;
    Direction const front = std::abs(axis.z()) < nearly_z ? Direction(0, 0, 1) : Direction(0, -1, 0);
    Direction const right = axis.cross(front).normalized(), ahead = right.cross(axis);
    Vector const o = point.position - f.from;
    float const x = o.dot(right), z = o.dot(ahead), along = o.dot(axis) / h, r = std::hypot(x, z);
    float const sine = r > 0 ? x / r : 0, cosine = r > 0 ? z / r : 1;
    float const least = 1e-4f * std::max(f.radius, f.top_radius);  // as at the sphere's pole
    point.uv = {0.5f + std::atan2(x, z) / (2 * pi), along};
    point.dp_du = 2 * pi * std::max(r, least) * (cosine * right - sine * ahead);
    point.dp_dv = h * axis + (f.top_radius - f.radius) * (sine * right + cosine * ahead);
}

void parametrise_shape(MeshShape const& m, HitCoordinates const& hit, SurfacePoint& point) {
    auto const& t = m.mesh->triangle[hit.primitive];
    auto const& position = m.mesh->position;
    Vector const a = position[t[1]] - position[t[0]], b = position[t[2]] - position[t[0]];
    Frame const any = Frame::around(point.geometric_normal);
    point.uv = {0, 0};
    point.dp_du = any.tangent;
    point.dp_dv = any.bitangent;
    if (m.mesh->uv.empty()) return;
    auto const& uv = m.mesh->uv;
    Vector2 const du = uv[t[1]] - uv[t[0]], dv = uv[t[2]] - uv[t[0]];
    point.uv = uv[t[0]] + hit.u * du + hit.v * dv;
    float const determinant = du.x() * dv.y() - du.y() * dv.x();
    constexpr float collapsed = 1e-12f;  // of the product of the sides: the triangle has no area in uv
    if (!(std::abs(determinant) > collapsed * du.norm() * dv.norm())) return;
    point.dp_du = (dv.y() * a - du.y() * b) / determinant;
    point.dp_dv = (du.x() * b - dv.x() * a) / determinant;
}

}  // namespace

void parametrise(ShapeGeometry const& geometry, HitCoordinates const& hit, SurfacePoint& point) {
    std::visit([&](auto const& g) { parametrise_shape(g, hit, point); }, geometry);
}

void turn_normal(SurfacePoint& point, Direction const& normal) {
    point.normal = normal;
    Vector const across = point.dp_du - normal * normal.dot(point.dp_du);
    float const length2 = across.squaredNorm();
    point.tangent = length2 > 0 ? Direction(across / std::sqrt(length2)) : Frame::around(normal).tangent;
}

void set_tangent_and_footprint(SurfacePoint& point, Direction const& ray_direction, float width) {
    turn_normal(point, point.normal);
    point.across_ray = point.along_ray = {0, 0};
    if (!(width > 0)) return;
    constexpr float grazing = 0.01f;  // cosine: a longer footprint is as good as this one, 100 times its width
    Direction const& n = point.geometric_normal;
    float const cosine = ray_direction.dot(n);
    Vector const in_plane = ray_direction - cosine * n;
    float const sine2 = in_plane.squaredNorm();
    Direction const along = sine2 > 1e-12f ? Direction(in_plane / std::sqrt(sine2)) : Frame::around(n).tangent;
    float const E = point.dp_du.squaredNorm(), F = point.dp_du.dot(point.dp_dv), G = point.dp_dv.squaredNorm();
    float const determinant = E * G - F * F;
    if (!(determinant > 0)) return;
    auto const in_uv = [&](Vector const& w) {
        float const x = point.dp_du.dot(w), y = point.dp_dv.dot(w);
        return Vector2(Vector2(G * x - F * y, E * y - F * x) / determinant);
    };
    point.across_ray = in_uv(width * n.cross(along));
    point.along_ray = in_uv(width / std::max(std::abs(cosine), grazing) * along);
}

}  // namespace iride
