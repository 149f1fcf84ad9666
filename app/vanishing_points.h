// SPDX-License-Identifier: Apache-2.0
// Where the lines along the world's axes meet in the picture, as `iride plan` says it.
#pragma once

#include <fmt/format.h>

#include "scene/projection.h"
#include "scene/scene.h"

namespace iride {

inline std::string vanishing_points(Scene const& scene) {
    PictureProjection const projection(scene.camera, scene.film.width, scene.film.height);
    std::string text = "  vanishing points, pixels from the top left of the picture:\n";
    for (auto const& [name, axis] :
         {std::pair("x", VectorDouble(1, 0, 0)), {"y", VectorDouble(0, 1, 0)}, {"z", VectorDouble(0, 0, 1)}}) {
        auto const there = projection.vanishing_point(axis), back = projection.vanishing_point(-axis);
        text += fmt::format("    {} axis  ", name);
        if (!there)
            text += "at infinity: its lines stay parallel\n";
        else if (std::hypot(there->x - back->x, there->y - back->y) < 1e-6 * scene.film.height)
            text += fmt::format("({:.2f}, {:.2f})\n", there->x, there->y);
        else  // a panorama sees both ends
            text += fmt::format("+{}: ({:.2f}, {:.2f}), -{}: ({:.2f}, {:.2f})\n", name, there->x, there->y, name,
                                back->x, back->y);
    }
    return text;
}

}  // namespace iride
