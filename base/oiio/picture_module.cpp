// SPDX-License-Identifier: Apache-2.0
#include "base/oiio/picture_module.h"

#include <OpenImageIO/imageio.h>
#include <fmt/format.h>

#include <algorithm>

namespace iride {

namespace {

std::string what_is_wrong(OIIO::ImageSpec const& spec, PictureWish const& wish) {
    constexpr int largest_side = 32768;
    if (spec.nchannels < wish.least_channels)
        return fmt::format("found {} channels, but at least {} are wanted", spec.nchannels, wish.least_channels);
    if (spec.width < wish.least_width || spec.height < 1 || spec.width > largest_side || spec.height > largest_side)
        return fmt::format("found {} x {} pixels, allowed: {} x 1 .. {} squared", spec.width, spec.height,
                           wish.least_width, largest_side);
    if (spec.depth > 1 || spec.deep) return "is a volume or a deep picture";
    return "";
}

std::string read(std::string const& path, PictureWish const& wish, Picture& picture) {
    auto const input = OIIO::ImageInput::open(path);
    if (!input) return "not a readable picture: " + OIIO::geterror();
    OIIO::ImageSpec const spec = input->spec();
    if (std::string const wrong = what_is_wrong(spec, wish); !wrong.empty()) return wrong;
    picture = {
        spec.width, spec.height, std::min(spec.nchannels, wish.most_channels), !spec.format.is_floating_point(), {}};
    auto const row = static_cast<std::size_t>(picture.width) * static_cast<std::size_t>(picture.channels);
    bool const tiled = spec.tile_width > 0;
    int const piece = tiled ? spec.tile_height : 64;  // rows: memory grows only as far as the file proves to hold it
    for (int y = 0; y < spec.height; y += piece) {
        int const end = std::min(spec.height, y + piece);
        picture.value.resize(row * static_cast<std::size_t>(end));
        void* const rows = picture.value.data() + row * static_cast<std::size_t>(y);
        bool const done = tiled ? input->read_tiles(0, 0, spec.x, spec.x + spec.width, spec.y + y, spec.y + end, spec.z,
                                                    spec.z + 1, 0, picture.channels, OIIO::TypeDesc::FLOAT, rows)
                                : input->read_scanlines(0, 0, spec.y + y, spec.y + end, spec.z, 0, picture.channels,
                                                        OIIO::TypeDesc::FLOAT, rows);
        if (!done) return "truncated or damaged: " + input->geterror();
    }
    return "";
}

std::string write_png(std::string const& path, int width, int height, std::uint8_t const* bytes) {
    auto const output = OIIO::ImageOutput::create(path);
    if (!output) return OIIO::geterror();
    OIIO::ImageSpec const spec(width, height, 3, OIIO::TypeDesc::UINT8);
    if (!output->open(path, spec) || !output->write_image(OIIO::TypeDesc::UINT8, bytes) || !output->close())
        return output->geterror();
    return "";
}

constexpr PictureModule module{read, write_png};

}  // namespace

extern "C" PictureModule const* iride_picture_module() { return &module; }

}  // namespace iride
