// SPDX-License-Identifier: Apache-2.0
// The point of a shape that a ray met, in the shape's coordinates: position and normals. `on_ray` is the point along
// the ray: shapes with a closed form pull it onto the surface, which leaves an error of a few units in the last place.
// Filled in place: the rest of a SurfacePoint is for those who ask for it (scene/parametrisation.h).
#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>

#include "scene/frustum_intersection.h"

namespace iride {

// Barycentric coordinates of a triangle or quad, as Embree gives them, and the triangle of a mesh.
struct HitCoordinates {
    float u, v;
    std::uint32_t primitive;
};

inline void set_plain(SurfacePoint& point, Vector const& position, Direction const& normal) {
    point.position = position;
    point.geometric_normal = point.normal = normal;
    point.size = 0;
}

// Places keep off the edges of triangles, by some units in the last place of a coordinate as large as they: one in the
// plane of a wall that stands at the edge would be as good as behind it, and let light into closed bodies.
inline constexpr float off_edges = 4 * std::numeric_limits<float>::epsilon();

inline void locate(Sphere const& s, Vector const& on_ray, HitCoordinates const&, SurfacePoint& point) {
    Direction const n = unit(on_ray - s.centre);
    set_plain(point, s.centre + s.radius * n, n);
    point.size = s.radius;
}
inline void locate(Quad const& q, Vector const&, HitCoordinates const& hit, SurfacePoint& point) {
    // A quad is traced as the triangles (0 1 3), of coordinates (u, v), and (2 3 1), of (1 - u, 1 - v). Which of them
    // is as good as random: chosen without a branch.
    bool const first = hit.u + hit.v <= 1;
    Vector const &a = q.corner[first ? 0 : 2], &b = q.corner[first ? 1 : 3], &c = q.corner[first ? 3 : 1];
    float const u = std::max(first ? hit.u : 1 - hit.u, off_edges), v = std::max(first ? hit.v : 1 - hit.v, off_edges);
    set_plain(point, a + u * (b - a) + v * (c - a), q.normal);
}
inline void locate(Disc const& d, Vector const& on_ray, HitCoordinates const&, SurfacePoint& point) {
    set_plain(point, on_ray - d.normal * d.normal.dot(on_ray - d.centre), d.normal);
}
inline void locate(Frustum const& f, Vector const& on_ray, HitCoordinates const&, SurfacePoint& point) {
    auto const [position, normal] = project(f, on_ray);
    set_plain(point, position, normal);
}
inline void locate(MeshShape const& m, Vector const&, HitCoordinates const& hit, SurfacePoint& point) {
    auto const& t = m.mesh->triangle[hit.primitive];
    Vector const &a = m.mesh->position[t[0]], &b = m.mesh->position[t[1]], &c = m.mesh->position[t[2]];
    float u = std::max(hit.u, off_edges), v = std::max(hit.v, off_edges);
    float const inwards = std::min(1.0f, (1 - off_edges) / (u + v));
    u *= inwards, v *= inwards;
    float const w = 1 - u - v;
    Direction const n = unit((b - a).cross(c - a));
    set_plain(point, w * a + u * b + v * c, n);
    if (m.smooth && !m.mesh->normal.empty()) {
        auto const& N = m.mesh->normal;
        point.normal = unit(w * N[t[0]] + u * N[t[1]] + v * N[t[2]]);
        if (point.normal.dot(n) < 0) point.normal = -point.normal;  // the winding decides which side is the front
    }
}

}  // namespace iride
