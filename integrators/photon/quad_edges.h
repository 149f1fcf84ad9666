// SPDX-License-Identifier: Apache-2.0
// Discs that reach over the edges of a quad: what of them lies on it, and where to put them again so that what lies
// beyond an edge is folded back.
#pragma once

#include "scene/shape.h"

namespace iride {

// Area of the part on the quad [m^2].
float disc_area_in_quad(Quad const& quad, Vector const& centre, float radius);

// The images in its edges, and in its corners, of the centre of a disc that reaches over them.
template <class Put>
void for_images(Quad const& quad, Vector const& centre, float radius, Put&& put) {
    struct Edge {
        Vector corner, inward;
        float height(Vector const& p) const { return inward.dot(p - corner); }
        Vector image(Vector const& p) const { return p - 2 * height(p) * inward; }
    };
    auto const edge = [&](std::size_t i) {
        Vector const &a = quad.corner[i % 4], &b = quad.corner[(i + 1) % 4];
        return Edge{a, quad.normal.cross(b - a).normalized()};
    };
    for (std::size_t i = 0; i < 4; ++i) {
        Edge const here = edge(i), next = edge(i + 1);
        if (!(here.height(centre) < radius)) continue;
        Vector const image = here.image(centre);
        put(image);
        if (!(next.height(centre) < radius)) continue;
        // Of an obtuse corner the image's image may be on the quad.
        if (Vector const again = next.image(image); here.height(again) < 0 && next.height(again) < 0) put(again);
    }
}

}  // namespace iride
