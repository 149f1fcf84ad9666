// SPDX-License-Identifier: Apache-2.0
#include "film/preview.h"

#include <OpenImageIO/imageio.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/atomic_file.h"
#include "base/diagnostics.h"

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
    auto const fail = [&](std::string const& why) {
        throw InputError({path.string()}, "", "cannot be written: " + why);
    };
    if (path.extension() != ".png") fail("a preview's name ends in .png");
    AtomicFile file(path);
    auto const output = OIIO::ImageOutput::create(path.string());
    if (!output) fail(OIIO::geterror());
    OIIO::ImageSpec const spec(image.width, image.height, 3, OIIO::TypeDesc::UINT8);
    if (!output->open(file.temporary().string(), spec)) fail(output->geterror());
    if (!output->write_image(OIIO::TypeDesc::UINT8, bytes.data())) fail(output->geterror());
    if (!output->close()) fail(output->geterror());
    file.commit();
}

}  // namespace iride
