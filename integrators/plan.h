// SPDX-License-Identifier: Apache-2.0
// What a scene needs and what it does not: found once before rendering, so that the kernels carry nothing in vain.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "scene/bodies.h"

namespace iride {

// The scene's materials that are wanted, by name and separated by commas.
std::string names_of(Scene const& scene, bool (*wanted)(NamedMaterial const&));

struct RenderPlan {
    bool dispersion = false;      // lanes part company somewhere: carry their reach
    bool media = false;           // bodies absorb or lie in one another: carry what a path is in
    bool scattering = false;      // some medium scatters: flights end by chance, lanes part company there too
    bool beams = false;           // lamps without extent shine through media that scatter: looked for beside flights
    bool light_sampling = true;   // some light can be sampled, and some surface can use it
    bool environment = false;     // paths that leave the scene may bring radiance
    WavelengthRange wavelengths;  // where lamps and (observer or bands) overlap: what is sampled
    bool bands = false;
    bool ray_cones = false;       // a texture is averaged over what a path stands for
    bool observer_alone = false;  // wavelengths are not drawn for the lamps, even where that is quieter
    std::string no_light_paths;   // why the picture can have none beside its camera paths; empty: it can
    bool whole_paths = false;     // a layer wants the same paths again
    std::optional<int> max_bounces;
    LightSelection light_selection = LightSelection::power;
    UniformLight uniform_light = UniformLight::asked;
    std::optional<Surroundings> camera_in;  // absent: not the same for all camera rays

    struct Decision {
        std::string name;
        bool used;
        std::string reason;
    };
    std::vector<Decision> decisions;
};

RenderPlan make_plan(Scene const& scene);

// What camera rays start in, at places all over the lens and the window; absent if they differ.
std::optional<Surroundings> surroundings_of_camera(Scene const& scene);

}  // namespace iride
