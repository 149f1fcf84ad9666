// SPDX-License-Identifier: Apache-2.0
// Pictures in files, as they are stored: no colour management here. OpenImageIO reads and writes them, from a module of
// its own (oiio/) that is loaded when the first picture is: with its 260 libraries it takes .25 s, which a command that
// touches no picture must not pay.
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace iride {

struct Picture {
    int width = 0, height = 0, channels = 0;
    bool integers = false;     // stored as integers: 0 .. 1 here
    std::vector<float> value;  // [row][column][channel], from the top left
    float at(int x, int y, int channel) const {
        return value[(static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x)) *
                         static_cast<std::size_t>(channels) +
                     static_cast<std::size_t>(channel)];
    }
};

// What a picture must be to be read.
struct PictureWish {
    bool scene_linear_only = false;  // OpenEXR or Radiance HDR; else PNG, JPEG and TIFF as well
    int least_channels = 1, most_channels = 4;
    int least_width = 1;
};

// Channels beyond the most are left out. Throws InputError for: no such file, empty, above 1 GiB, another format,
// sides above 32768, too few channels, truncated or damaged.
Picture read_picture(std::filesystem::path const& path, PictureWish const& wish);

// 8 bits per channel, R G B, [height][width][3]; whole or not at all. Throws InputError.
void write_png(std::filesystem::path const& path, int width, int height, std::span<std::uint8_t const> bytes);

}  // namespace iride
