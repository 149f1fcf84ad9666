// SPDX-License-Identifier: Apache-2.0
// OpenEXR files out and in. Written whole or not at all.
//
// Channels: R G B (or X Y Z) in the output space; S0.550,000000nm ... for bands, the layout of [Fichet 2021];
// variance.X variance.Y variance.Z: variance of the mean, of XYZ at exposure 1, always float; count, of samples, where
// pixels differ in it or parts were merged; more layers on request (integrators/layers.h).
// Attributes: chromaticities (typed), whiteLuminance [cd m^-2 of RGB (1,1,1), or of Y = 1], colorInteropID, sceneWhite
// (x, y that was adapted to the file's white), spectralLayoutVersion and emissiveUnits when there are bands, and under
// "iride:" version, sceneHash, scene, integrator, sampler, spp, weight [of a sample, film/film.h], seed, firstSample,
// observer, exposure, bands, adaptive, parts and rejected.* counts. A film that is a part of a picture is the data
// window in the picture's display window.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "colour/rgb_space.h"
#include "film/film.h"
#include "film/image.h"

namespace iride {

struct ExrSettings {
    std::string colourspace = "ACEScg";
    Chromaticity scene_white{0.3127, 0.3290};
    double exposure = 1;
    bool half = false;
    std::string scene, scene_hash, integrator;
    std::uint64_t seed = 0;
    std::string sampler = "sobol";
    std::uint32_t first_sample = 0;  // of every pixel
    bool adaptive = false;           // pixels have numbers of samples that follow from what was found
    int parts = 1;                   // that were merged
};

// The film's XYZ through the output space, times the exposure.
Image<std::array<float, 3>> to_image(Film const& film, OutputSpace const& space, double exposure);

// More channels beside the picture's, always float, and text attributes.
struct ExtraLayers {
    std::vector<std::pair<std::string, std::vector<float>>> channels;  // name, [height][width]
    std::vector<std::pair<std::string, std::string>> attributes;
};

void write_exr(Film const& film, ExrSettings const& settings, std::filesystem::path const& path,
               ExtraLayers const& extra = {});

// Throws InputError for what is no flat OpenEXR file of a sane size; reading may still find it damaged.
void check_exr(std::filesystem::path const& path);

// A picture read back as XYZ: from its X Y Z channels, or R G B by its own chromaticities (linear Rec.709 if it names
// none) and, if it has a sceneWhite, with the adaptation undone. `variance` is empty unless the file has it (and then
// refers to exposure 1). Any OpenEXR file; throws InputError if it is missing, truncated, no EXR, deep or has no
// colour. Of the channels beside these, those that `wanted` names are read as they are.
struct XyzPicture {
    Image<Xyz> xyz, variance;
    double exposure = 1;
    std::vector<std::pair<double, Image<float>>> bands;  // centre [nm], radiance

    // What merging wants to know beside (film/exr_part.h).
    Image<float> count{};                        // samples in each pixel's mean; empty unless the file has it
    FilmPlace place{0, 0, 0, 0};                 // data window in display window
    Chromaticity white{0.3127, 0.3290};          // sceneWhite
    bool half = false;                           // colour as 16-bit floats
    std::map<std::string, std::string> facts{};  // attributes "iride:KEY" by KEY, as text
    std::optional<RgbSpace> rgb{};               // of its colour; X Y Z have none
    std::vector<std::string> other_channels{};   // beside all these
    ExtraLayers layers{};                        // the wanted ones of them; all other attributes that are text
};
using ChannelFilter = bool (*)(std::string const& channel);
inline bool no_channel(std::string const&) { return false; }
XyzPicture read_exr_as_xyz(std::filesystem::path const& path, ChannelFilter wanted = no_channel);

// XYZ of a colour in `rgb`, or X Y Z itself, that was adapted from a white: the inverse of output_space().from_xyz.
MatrixDouble xyz_of_output(std::optional<RgbSpace> const& rgb, Chromaticity const& scene_white);

}  // namespace iride
