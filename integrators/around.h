// SPDX-License-Identifier: Apache-2.0
// The neighbourhood of a pixel.
#pragma once

#include <algorithm>

#include "film/image.h"

namespace iride {

// visit(pixel) for each that is there, at most `reach` rows and columns away; how many they are.
template <class Pixel, class Visit>
int for_each_around(Image<Pixel> const& image, int x, int y, int reach, Visit&& visit) {
    int count = 0;
    for (int v = std::max(0, y - reach); v <= std::min(image.height - 1, y + reach); ++v)
        for (int u = std::max(0, x - reach); u <= std::min(image.width - 1, x + reach); ++u, ++count)
            visit(image.at(u, v));
    return count;
}

}  // namespace iride
