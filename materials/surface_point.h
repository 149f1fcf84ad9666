// SPDX-License-Identifier: Apache-2.0
// A point of a surface, as a material may look at it, and how it was met.
#pragma once

#include "base/vector.h"

namespace iride {

struct SurfacePoint {
    Vector position;
    Direction geometric_normal;  // on the front side of the shape
    Direction normal;            // for shading; on the front side too
    Vector2 uv{0, 0};
    bool from_front = true;  // seen from the front side of the shape
    float choice = 0.5f;     // a random number in [0, 1) of this meeting: which part of a mixture scatters
};

}  // namespace iride
