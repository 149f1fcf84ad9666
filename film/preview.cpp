// SPDX-License-Identifier: Apache-2.0
#include "film/preview.h"

#include <algorithm>
#include <cmath>

#include "base/picture.h"

namespace iride {

void write_preview(Film const& film, Chromaticity const& scene_white, double exposure, ColourTransform const& display,
                   std::filesystem::path const& path) {
    auto image = to_image(film, output_space("ACEScg", scene_white), exposure);
    display.apply({image.pixel.front().data(), image.pixel.size() * 3});
    std::vector<std::uint8_t> bytes;
    for (auto const& pixel : image.pixel) {
        bool const broken = std::ranges::any_of(pixel, [](float c) { return std::isnan(c); });
        constexpr std::array<float, 3> magenta{1, 0, 1};
        for (float c : broken ? magenta : pixel)
            bytes.push_back(static_cast<std::uint8_t>(std::lround(255 * std::clamp(c, 0.0f, 1.0f))));
    }
    write_png(path, image.width, image.height, bytes);
}

}  // namespace iride
