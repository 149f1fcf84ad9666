// SPDX-License-Identifier: Apache-2.0
#include "integrators/photon/quad_edges.h"

#include "integrators/photon/disc_area.h"

namespace iride {

float disc_area_in_quad(Quad const& quad, Vector const& centre, float radius) {
    Vector const along = (quad.corner[1] - quad.corner[0]).normalized(), across = quad.normal.cross(along);
    std::array<Eigen::Vector2d, 4> corner;
    for (std::size_t i = 0; i < 4; ++i) {
        Vector const d = quad.corner[i] - centre;
        corner[i] = {static_cast<double>(along.dot(d)), static_cast<double>(across.dot(d))};
    }
    return static_cast<float>(disc_area_in_polygon(corner, {0, 0}, static_cast<double>(radius)));
}

}  // namespace iride
