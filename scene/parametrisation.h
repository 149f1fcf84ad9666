// SPDX-License-Identifier: Apache-2.0
// uv of each shape, and what follows from it. v goes up, and seen from the front u goes to the right of it, so that a
// picture (its top row at v = 1) is upright and not mirrored.
//   sphere           u = 1/2 + azimuth / 2 pi, azimuth 0 at +z growing towards +x;  v = 1/2 + latitude / pi, poles on y
//   quad, box face   its corners are (0,0) (1,0) (1,1) (0,1), bilinear between
//   disc             the square around it, v along what is left of +y in its plane (of -z if it faces +-y)
//   cylinder, cone   u as the sphere's with the axis for y (and -y for z if the axis is z), v = 0 .. 1 from `from` to
//   `to` mesh             the file's own; without it (0, 0), and a tangent that nobody chose
#pragma once

#include "scene/surface.h"

namespace iride {

// Sets uv, dp_du and dp_dv of a point that locate() has set, in the shape's coordinates.
void parametrise(ShapeGeometry const& geometry, HitCoordinates const& hit, SurfacePoint& point);

// Sets tangent, across_ray and along_ray from the derivatives, for a ray of diameter `width` [m] at the point.
void set_tangent_and_footprint(SurfacePoint& point, Direction const& ray_direction, float width);

// Another shading normal, and the tangent across it.
void turn_normal(SurfacePoint& point, Direction const& normal);

}  // namespace iride
