// SPDX-License-Identifier: Apache-2.0
#include "base/picture.h"

#include <dlfcn.h>
#include <fmt/format.h>

#include <fstream>

#include "base/atomic_file.h"
#include "base/diagnostics.h"
#include "base/oiio/picture_module.h"

namespace iride {

namespace {

PictureModule const& picture_module() {
    static PictureModule const* const module = [] {
        void* const library = dlopen(IRIDE_PICTURE_MODULE, RTLD_NOW | RTLD_LOCAL);
        void* const symbol = library ? dlsym(library, picture_module_symbol) : nullptr;
        if (!symbol) throw InputError({IRIDE_PICTURE_MODULE}, "", fmt::format("cannot be loaded: {}", dlerror()));
        return reinterpret_cast<GetPictureModule>(symbol)();
    }();
    return *module;
}

// OpenImageIO tries every format it knows on any file, some of them byte by byte: only what begins as one of these is
// handed to it.
void check_picture_file(std::filesystem::path const& path, PictureWish const& wish) {
    auto const fail = [&](std::string const& message) { return InputError({path.string()}, "", message); };
    std::error_code error;
    if (!std::filesystem::is_regular_file(path, error)) throw fail("no such file");
    constexpr std::uintmax_t largest_file = 1ull << 30;  // bytes
    std::uintmax_t const size = std::filesystem::file_size(path, error);
    if (size == 0) throw fail("the file is empty");
    if (size > largest_file)
        throw fail(fmt::format("has {} MiB, allowed: at most {} MiB", size >> 20, largest_file >> 20));
    std::string start(4, '\0');
    std::ifstream(path, std::ios::binary).read(start.data(), 4);
    auto const begins = [&](std::string_view magic) { return start.starts_with(magic); };
    if (begins("\x76\x2f\x31\x01") || begins("#?")) return;
    if (wish.scene_linear_only) throw fail("is neither an OpenEXR nor a Radiance HDR picture");
    using namespace std::string_view_literals;
    if (!begins("\x89PNG") && !begins("\xff\xd8\xff") && !begins("II*\0"sv) && !begins("MM\0*"sv))
        throw fail("is no OpenEXR, Radiance HDR, PNG, JPEG or TIFF picture");
}

}  // namespace

Picture read_picture(std::filesystem::path const& path, PictureWish const& wish) {
    check_picture_file(path, wish);
    Picture picture;
    std::string const wrong = picture_module().read(path.string(), wish, picture);
    if (!wrong.empty()) throw InputError({path.string()}, "", wrong);
    return picture;
}

void write_png(std::filesystem::path const& path, int width, int height, std::span<std::uint8_t const> bytes) {
    auto const fail = [&](std::string const& why) {
        throw InputError({path.string()}, "", "cannot be written: " + why);
    };
    if (path.extension() != ".png") fail("a preview's name ends in .png");
    AtomicFile file(path);
    std::string const wrong = picture_module().write_png(file.temporary().string(), width, height, bytes.data());
    if (!wrong.empty()) fail(wrong);
    file.commit();
}

}  // namespace iride
