// SPDX-License-Identifier: Apache-2.0
#include "colour/colour_config.h"

#include <OpenColorIO/OpenColorIO.h>
#include <fmt/format.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cstdlib>

#include "base/diagnostics.h"
#include "spectral/catalogue.h"

namespace iride {

namespace ocio = OCIO_NAMESPACE;

struct ColourTransform::Processor {
    ocio::ConstCPUProcessorRcPtr cpu;
};

struct ColourConfig::Config {
    ocio::ConstConfigRcPtr ocio;
};

namespace {

// OpenColorIO allocates two RGBA rows per call. Pixels go to it as a picture of short rows, whatever the real width: 8
// KiB each stay in the nearest cache, and are not given back to the system after a call, as long ones are.
constexpr std::size_t row_pixels = 512, block_pixels = 64 * row_pixels;

std::filesystem::path chosen_config(std::filesystem::path const& config) {
    if (!config.empty()) return config;
    char const* const variable = std::getenv("OCIO");
    return variable && *variable ? std::filesystem::path(variable) : data_folder() / "ocio" / "config.ocio";
}

[[noreturn]] void fail(std::filesystem::path const& config, std::string const& key, std::string const& message) {
    throw InputError({config.string()}, key, message);
}

ocio::ConstConfigRcPtr load(std::filesystem::path const& path) {
    std::error_code error;
    if (!std::filesystem::is_regular_file(path, error)) fail(path, "", "no such OpenColorIO config");
    try {
        auto const config = ocio::Config::CreateFromFile(path.c_str());
        config->validate();
        return config;
    } catch (std::exception const& e) {
        fail(path, "", fmt::format("OpenColorIO refuses this config: {}", e.what()));
    }
}

// `wanted`, or the default if it is empty; it must be one of `allowed`.
std::string chosen(std::filesystem::path const& config, char const* key, std::string const& wanted,
                   std::string const& standard, std::vector<std::string> const& allowed) {
    std::string const name = wanted.empty() ? standard : wanted;
    if (std::ranges::find(allowed, name) == allowed.end())
        fail(config, key, fmt::format("unknown {} '{}'{}", key, name, suggestion(name, allowed)));
    return name;
}

}  // namespace

void ColourTransform::apply(std::span<float> rgb, int threads) const {
    auto const convert = [&](std::size_t begin, std::size_t width, std::size_t height) {
        if (height == 0 || width == 0) return;
        ocio::PackedImageDesc image(rgb.data() + 3 * begin, static_cast<long>(width), static_cast<long>(height), 3);
        processor_->cpu->apply(image);
    };
    std::size_t const pixels = rgb.size() / 3, blocks = (pixels + block_pixels - 1) / block_pixels;
    auto const convert_block = [&](std::size_t i) {
        std::size_t const begin = i * block_pixels, end = std::min(pixels, begin + block_pixels);
        std::size_t const rows = (end - begin) / row_pixels, rest = (end - begin) % row_pixels;
        convert(begin, row_pixels, rows);
        convert(end - rest, rest, 1);
    };
    if (threads == 1 || blocks <= 1) {
        for (std::size_t i = 0; i < blocks; ++i) convert_block(i);
        return;
    }
    tbb::task_arena arena(threads > 0 ? threads : tbb::task_arena::automatic);
    arena.execute([&] { tbb::parallel_for(std::size_t{0}, blocks, convert_block); });
}

ColourConfig::ColourConfig(std::filesystem::path const& file)
    : config_(std::make_shared<Config>(Config{load(chosen_config(file))})), path_(chosen_config(file)) {}

std::vector<ConfigSpace> ColourConfig::spaces() const {
    std::vector<ConfigSpace> all;
    ocio::Config const& config = *config_->ocio;
    int const count = config.getNumColorSpaces(ocio::SEARCH_REFERENCE_SPACE_ALL, ocio::COLORSPACE_ALL);
    for (int i = 0; i < count; ++i) {
        auto const space = config.getColorSpace(
            config.getColorSpaceNameByIndex(ocio::SEARCH_REFERENCE_SPACE_ALL, ocio::COLORSPACE_ALL, i));
        ConfigSpace found{
            space->getName(), {}, space->getReferenceSpaceType() == ocio::REFERENCE_SPACE_DISPLAY, space->isData()};
        for (std::size_t a = 0; a < space->getNumAliases(); ++a) found.aliases.emplace_back(space->getAlias(a));
        all.push_back(std::move(found));
    }
    return all;
}

bool ColourConfig::has_role(std::string const& role) const { return config_->ocio->hasRole(role.c_str()); }

std::vector<std::string> ColourConfig::displays() const {
    std::vector<std::string> names;
    for (int i = 0; i < config_->ocio->getNumDisplays(); ++i) names.emplace_back(config_->ocio->getDisplay(i));
    return names;
}

std::vector<std::string> ColourConfig::views(std::string const& display) const {
    std::vector<std::string> names;
    for (int i = 0; i < config_->ocio->getNumViews(display.c_str()); ++i)
        names.emplace_back(config_->ocio->getView(display.c_str(), i));
    return names;
}

ColourTransform ColourConfig::between(std::string const& from, std::string const& to) const {
    for (std::string const& name : {from, to})
        if (!config_->ocio->getColorSpace(name.c_str())) {
            std::vector<std::string> names;
            for (ConfigSpace const& space : spaces()) names.push_back(space.name);
            fail(path_, "", fmt::format("has no colour space or role '{}'{}", name, suggestion(name, names)));
        }
    try {
        auto const processor = config_->ocio->getProcessor(from.c_str(), to.c_str());
        return ColourTransform(std::make_shared<ColourTransform::Processor const>(
            ColourTransform::Processor{processor->getOptimizedCPUProcessor(ocio::OPTIMIZATION_LOSSLESS)}));
    } catch (std::exception const& e) {
        fail(path_, "", fmt::format("no way from '{}' to '{}': {}", from, to, e.what()));
    }
}

ColourTransform ColourConfig::to_display(std::string const& wanted_display, std::string const& wanted_view) const {
    ocio::Config const& config = *config_->ocio;
    std::string const display = chosen(path_, "display", wanted_display, config.getDefaultDisplay(), displays());
    std::string const view = chosen(path_, "view", wanted_view, config.getDefaultView(display.c_str()), views(display));
    char const* source = nullptr;
    for (char const* name : {"ACEScg", "ACES - ACEScg", "lin_ap1", "lin_ap1_scene"})
        if (!source && config.getColorSpace(name)) source = name;
    if (!source)
        fail(path_, "", "has no colour space ACEScg (looked for: ACEScg, ACES - ACEScg, lin_ap1, lin_ap1_scene)");
    try {
        auto const processor = config.getProcessor(source, display.c_str(), view.c_str(), ocio::TRANSFORM_DIR_FORWARD);
        return ColourTransform(std::make_shared<ColourTransform::Processor const>(
            ColourTransform::Processor{processor->getOptimizedCPUProcessor(ocio::OPTIMIZATION_LOSSLESS)}));
    } catch (std::exception const& e) {
        fail(path_, "view", e.what());
    }
}

}  // namespace iride
