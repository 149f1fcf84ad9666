// SPDX-License-Identifier: Apache-2.0
// Coordinates are floats: far from the origin they lie coarsely, and rays start coarsely off surfaces there
// (uncertainty). A scene whose smallest object is not much larger than that is told so.
#pragma once

#include <optional>

#include "scene/scene.h"

namespace iride {

// A remark with the grid, the offset and the smallest object, if the offset is more than a hundredth of that object.
std::optional<std::string> remark_on_float_grid(Scene const& scene);

}  // namespace iride
