// SPDX-License-Identifier: Apache-2.0
// A shading normal may let the viewer, or what it sees mirrored, fall behind the surface: black where it is near
// grazing. Such a normal is bent towards the viewer until the mirrored direction just leaves the surface:
//   r = 2 (n.wo) n - wo;  if r.g < e:  r' ~ r + (e - r.g) g,  n' ~ wo + r',  e = min(.01, g.wo)
// n' mirrors wo to r', faces both wo and g, and is n wherever n was good; it moves continuously. [Keller 2017]
#pragma once

#include <algorithm>

#include "base/vector.h"

namespace iride {

// For a viewer before the surface, wo.g >= 0.
inline Direction bent_to_viewer(Direction const& n, Direction const& g, Direction const& wo) {
    if (n == g) return n;
    constexpr float least = 0.01f;  // cosine: nothing of a mirror image is seen nearer to the surface
    float const cosine = wo.dot(g), wanted = std::min(least, cosine);
    Vector const mirrored = 2 * n.dot(wo) * n - wo;
    float const above = mirrored.dot(g);
    if (above >= wanted) return n;
    Vector const bisector = wo + (mirrored + (wanted - above) * g).normalized();
    float const length2 = bisector.squaredNorm();
    return length2 > 1e-12f ? Direction(bisector / std::sqrt(length2)) : g;
}

}  // namespace iride
