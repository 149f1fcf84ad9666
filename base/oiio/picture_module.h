// SPDX-License-Identifier: Apache-2.0
// What the module that holds OpenImageIO offers. Errors come back as text: "" is success.
#pragma once

#include "base/picture.h"

namespace iride {

struct PictureModule {
    std::string (*read)(std::string const& path, PictureWish const& wish, Picture& picture);
    std::string (*write_png)(std::string const& path, int width, int height, std::uint8_t const* bytes);
};

using GetPictureModule = PictureModule const* (*)();
inline constexpr char picture_module_symbol[] = "iride_picture_module";

}  // namespace iride
