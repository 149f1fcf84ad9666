// SPDX-License-Identifier: Apache-2.0
// An OpenColorIO config: its spaces and views, and the transforms between them. The only place that includes
// OpenColorIO. OpenColorIO works in float; with its lossless optimisation, since the default may take faster
// approximations of logarithms and powers (in Debian's build it does not: the same bits).
#pragma once

#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace iride {

// From one space to another, or to a display through a view. A value; copies share the processor.
class ColourTransform {
  public:
    // In place on interleaved RGB triples, any number of them; never clamped but by the transform itself. In blocks of
    // rows, by `threads` threads (0: all); the same bits for any number of them. May be called by several threads.
    void apply(std::span<float> rgb, int threads = 0) const;

  private:
    friend class ColourConfig;
    struct Processor;
    explicit ColourTransform(std::shared_ptr<Processor const> processor) : processor_(std::move(processor)) {}
    std::shared_ptr<Processor const> processor_;
};

// A colour space of a config. `display_referred`: it hangs on the display's reference space, not the scene's.
struct ConfigSpace {
    std::string name;
    std::vector<std::string> aliases;
    bool display_referred, is_data;
};

class ColourConfig {
  public:
    // Empty means $OCIO if set, else data/ocio/config.ocio. Throws InputError: no such file, or one that OpenColorIO
    // does not load or validate (in its words).
    explicit ColourConfig(std::filesystem::path const& file = {});

    std::filesystem::path const& path() const { return path_; }
    std::vector<ConfigSpace> spaces() const;
    bool has_role(std::string const& role) const;
    std::vector<std::string> displays() const;
    std::vector<std::string> views(std::string const& display) const;

    // `from` and `to`: names, aliases or roles. Throws InputError with the nearest name.
    ColourTransform between(std::string const& from, std::string const& to) const;
    // From scene-linear ACEScg. Empty: the config's default display, that display's default view. Throws InputError:
    // unknown display or view (with the allowed ones), no space that is called ACEScg.
    ColourTransform to_display(std::string const& display = {}, std::string const& view = {}) const;

  private:
    struct Config;
    std::shared_ptr<Config const> config_;
    std::filesystem::path path_;
};

}  // namespace iride
