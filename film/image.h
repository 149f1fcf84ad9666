// SPDX-License-Identifier: Apache-2.0
// A rectangle of pixels of one type, row by row from the top left.
#pragma once

#include <cstddef>
#include <vector>

namespace iride {

template <class Pixel>
struct Image {
    int width = 0, height = 0;
    std::vector<Pixel> pixel;  // [height][width]

    Image() = default;
    Image(int w, int h) : width(w), height(h), pixel(static_cast<std::size_t>(w) * static_cast<std::size_t>(h)) {}
    Pixel& at(int x, int y) { return pixel[index(x, y)]; }
    Pixel const& at(int x, int y) const { return pixel[index(x, y)]; }

  private:
    std::size_t index(int x, int y) const {
        return static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x);
    }
};

}  // namespace iride
