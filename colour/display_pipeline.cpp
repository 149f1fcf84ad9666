// SPDX-License-Identifier: Apache-2.0
#include "colour/display_pipeline.h"

#include <OpenColorIO/OpenColorIO.h>
#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>

#include "base/diagnostics.h"
#include "spectral/catalogue.h"

namespace iride {

namespace ocio = OCIO_NAMESPACE;

namespace {

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
    } catch (ocio::Exception const& e) {
        fail(path, "", fmt::format("OpenColorIO refuses this config: {}", e.what()));
    }
}

std::vector<std::string> displays_of(ocio::Config const& config) {
    std::vector<std::string> names;
    for (int i = 0; i < config.getNumDisplays(); ++i) names.emplace_back(config.getDisplay(i));
    return names;
}

std::vector<std::string> views_of(ocio::Config const& config, std::string const& display) {
    std::vector<std::string> names;
    for (int i = 0; i < config.getNumViews(display.c_str()); ++i)
        names.emplace_back(config.getView(display.c_str(), i));
    return names;
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

struct DisplayPipeline::Processor {
    ocio::ConstCPUProcessorRcPtr cpu;
};

DisplayPipeline::DisplayPipeline(std::filesystem::path const& config_path, std::string const& display,
                                 std::string const& view)
    : processor_(std::make_unique<Processor>()) {
    std::filesystem::path const path = chosen_config(config_path);
    ocio::ConstConfigRcPtr const config = load(path);
    display_ = chosen(path, "display", display, config->getDefaultDisplay(), displays_of(*config));
    view_ = chosen(path, "view", view, config->getDefaultView(display_.c_str()), views_of(*config, display_));
    // ACEScg by its usual names; else by the role, which an ACES config gives to it.
    char const* source = nullptr;
    for (char const* name : {"ACEScg", "ACES - ACEScg", "lin_ap1", "lin_ap1_scene"})
        if (!source && config->getColorSpace(name)) source = name;
    if (!source)
        fail(path, "", "has no colour space ACEScg (looked for: ACEScg, ACES - ACEScg, lin_ap1, lin_ap1_scene)");
    try {
        auto const processor =
            config->getProcessor(source, display_.c_str(), view_.c_str(), ocio::TRANSFORM_DIR_FORWARD);
        processor_->cpu = processor->getDefaultCPUProcessor();
    } catch (ocio::Exception const& e) {
        fail(path, "view", e.what());
    }
}

DisplayPipeline::~DisplayPipeline() = default;
DisplayPipeline::DisplayPipeline(DisplayPipeline&&) noexcept = default;

void DisplayPipeline::apply(std::span<float> rgb) const {
    ocio::PackedImageDesc image(rgb.data(), static_cast<long>(rgb.size() / 3), 1, 3);
    processor_->cpu->apply(image);
}

std::vector<std::string> display_views(std::filesystem::path const& config_path, std::string const& display) {
    ocio::ConstConfigRcPtr const config = load(chosen_config(config_path));
    return views_of(*config, display.empty() ? config->getDefaultDisplay() : display);
}

}  // namespace iride
