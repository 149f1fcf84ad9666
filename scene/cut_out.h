// SPDX-License-Identifier: Apache-2.0
// Surfaces with holes: of the rays that meet a surface of coverage alpha, the share alpha is stopped and the rest goes
// through unbent. Which, is told by a hash of the ray and the place: the same ray always fares alike, in packets,
// alone, for closest hits and for shadows, and the mean over rays is right without a random number.
#pragma once

#include "scene/parametrisation.h"

namespace iride {

// Whether a ray ends where it meets the shape at `distance`; everything in the shape's coordinates.
bool stops(Shape const& shape, Ray const& ray, float distance, HitCoordinates const& at);

// The nearest point of a frustum that stops the ray: the far side may be seen through the near one.
std::optional<float> first_stop(Shape const& shape, Frustum const& frustum, Ray ray);

}  // namespace iride
