// SPDX-License-Identifier: Apache-2.0
// A point of a surface, as a material may look at it, and how it was met.
#pragma once

#include "base/vector.h"

namespace iride {

struct SurfacePoint {
    Vector position;
    Direction geometric_normal;  // on the front side of the shape
    Direction normal;            // for shading; on the front side too
    float size = 0;              // [m] the position is at least as uncertain as a coordinate of this size; 0: not known

    // Set only where the shape's material asks for it (MaterialTraits), see scene/parametrisation.h.
    Vector2 uv{0, 0};
    Direction tangent{1, 0, 0};                 // along dp_du, across `normal`
    Vector dp_du{1, 0, 0}, dp_dv{0, 1, 0};      // metres per unit of u and v
    Vector2 across_ray{0, 0}, along_ray{0, 0};  // the two axes of the ray's footprint, in uv; 0: a point

    // Set when the material is asked for its closure (integrators/scattering.h).
    bool from_front = true;  // seen from the front side of the shape
    float choice = 0.5f;     // a random number in [0, 1) of this meeting: which part of a mixture scatters
};

}  // namespace iride
