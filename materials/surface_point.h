// SPDX-License-Identifier: Apache-2.0
// A point of a surface, as a material may look at it.
#pragma once

#include "base/vector.h"

namespace iride {

struct SurfacePoint {
    Vector position;
    Direction geometric_normal;  // on the front side of the shape
    Direction normal;            // for shading; on the front side too
    Vector2 uv{0, 0};
};

}  // namespace iride
