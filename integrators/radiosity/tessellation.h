// SPDX-License-Identifier: Apache-2.0
// A shape as a mesh of planar faces with edges of at most a wanted length, in world coordinates.
#pragma once

#include <array>
#include <vector>

#include "scene/shape.h"

namespace iride::radiosity {

struct Faces {
    std::vector<VectorDouble> position;
    struct Face {
        std::array<int, 4> vertex;  // counter-clockwise as seen from the front
        int corners;                // 3 or 4
    };
    std::vector<Face> face;
};

// Grids for quads, spheres, discs and frusta (at least 12 facets around); triangles are cut at their long edges until
// none is left, in two, three or four, by which edges are long: neighbours agree on every common edge. [Rivara 1984]
Faces tessellate(ShapeGeometry const& geometry, double size_m);

// About how many faces that would be.
double expected_faces(ShapeGeometry const& geometry, double size_m);

}  // namespace iride::radiosity
