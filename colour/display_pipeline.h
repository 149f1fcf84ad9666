// SPDX-License-Identifier: Apache-2.0
// From scene-linear ACEScg to a display, by an OpenColorIO view. The only place that includes OpenColorIO.
#pragma once

#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace iride {

class DisplayPipeline {
  public:
    // `config`: empty means $OCIO if set, else data/ocio/config.ocio. `display` and `view`: empty means the config's
    // default. Throws InputError: config missing or not loading (OCIO's own words), unknown display or view (with the
    // allowed ones), no ACEScg-like working space (role scene_linear / aces_interchange).
    DisplayPipeline(std::filesystem::path const& config, std::string const& display, std::string const& view);
    ~DisplayPipeline();
    DisplayPipeline(DisplayPipeline&&) noexcept;

    // In place on interleaved RGB triples, scene-linear ACEScg in, display-encoded 0..1 (not clamped) out. Thread-safe.
    void apply(std::span<float> rgb) const;

    std::string const& display() const { return display_; }
    std::string const& view() const { return view_; }

  private:
    struct Processor;
    std::unique_ptr<Processor> processor_;
    std::string display_, view_;
};

// The views of a config's default display (or of `display`), for messages and --help.
std::vector<std::string> display_views(std::filesystem::path const& config, std::string const& display = {});

}  // namespace iride
