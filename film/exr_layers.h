// SPDX-License-Identifier: Apache-2.0
// The layers beside a picture (integrators/layers.h) of its parts, merged to what one render of all their samples
// gives. With L_i the layer of part i, and w_i what that part's pixel weighs, 0 where the part does not cover it:
//   depth                          the least
//   position                       that of the part with the least depth; of equal ones, of the first samples
//   N, Ng, albedo                  sum of w_i L_i / sum of w_i with w_i = first_hits(pixel)
//   direct, indirect, group.NAME   the same with w_i = the samples in the pixel's mean
//   CryptoMaterial, CryptoObject   samples by id, w_i = first_hits(pixel) times the coverages, added and ranked again
// Colours go from each part's space to that of the merged file, adapted as they are there: light from the scene's white
// and times the exposure, albedo from D65.
#pragma once

#include <algorithm>
#include <optional>
#include <string>
#include <vector>

#include "film/checkpoint.h"

namespace iride {

inline constexpr std::uint32_t most_first_hits = 256;  // of a pixel: coverage to .4 %
// How many of a pixel's samples, its first ones, make its layers of first hits.
inline std::uint32_t first_hits(FilmPixel const& pixel) { return std::min(most_first_hits, pixel.taken()); }

// Whether a channel belongs to a layer that can be merged.
bool is_of_layer(std::string const& channel);

// What a part has beside its picture.
struct PartLayers {
    ExtraLayers read{};                   // the channels of layers, and attributes
    std::optional<RgbSpace> rgb{};        // of its colours; X Y Z have none
    std::vector<std::string> channels{};  // all of them
};
// A channel that holds what no render gives; absent if none does.
std::optional<std::string> impossible_value(PartLayers const& part);

struct MergedLayers {
    ExtraLayers layers;
    std::vector<std::vector<std::string>> left_out;  // channels of each part: of no layer, or of one that not all have
};
// Over the pixels of `whole`, which holds the parts, for a file of these settings. Of Cryptomatte layers the manifests
// must agree.
MergedLayers merged_layers(std::vector<Checkpoint> const& parts, std::vector<PartLayers> const& layers,
                           Film const& whole, ExrSettings const& settings);

}  // namespace iride
