// SPDX-License-Identifier: Apache-2.0
// What a picture can show beside its light: layers by name, found after it and apart from it, so that a render that is
// not asked for them runs as if they did not exist.
//   of the first hit of the picture's own camera rays, the first 256 of a pixel: depth, position, normals, albedo,
//   material, object; of the film: count, variance
//   direct: the same paths again, ended after one scattering; indirect: the rest. Their sum is the picture.
//   groups: the same paths again, what they find told apart by lights (integrators/light_groups.h). Their sum is too.
// How the layers of parts are merged says film/exr_layers.h, which knows them by their channels' names.
#pragma once

#include <array>
#include <span>

#include "film/exr.h"
#include "integrators/render.h"

namespace iride {

struct LayerEntry {
    char const* name;
    char const* summary;
};
std::span<LayerEntry const> layer_entries();

// Whether a layer is made of the picture's paths, by integrators that say what light a path found after how many
// scatterings.
bool is_made_of_paths(std::string const& layer);

// Names separated by commas, as on the command line.
std::vector<LayerRequest> parse_layers(std::string const& text);
// The names of what was asked for. Throws InputError with all that is wrong: unknown names, and what this integrator
// ("auto": the one it stands for), adaptive sampling or the scene cannot give.
std::vector<std::string> check_layers(std::vector<LayerRequest> const& requests, Scene const& scene,
                                      RenderPlan const& plan, std::string const& integrator, bool adaptive);

// What is written beside the film, in the output space and at the exposure of `settings`. Samples of `render` are those
// that made the film.
ExtraLayers make_layers(std::vector<std::string> const& names, Scene const& scene, RenderPlan const& plan,
                        std::string const& integrator, RenderSettings const& render, Film const& film,
                        ExrSettings const& settings);

}  // namespace iride
