// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <span>

namespace iride {

// Area of the part of a disc that lies in a polygon, whose corners go round counterclockwise.
double disc_area_in_polygon(std::span<Eigen::Vector2d const> corner, Eigen::Vector2d const& centre, double radius);

}  // namespace iride
