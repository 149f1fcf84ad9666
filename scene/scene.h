// SPDX-License-Identifier: Apache-2.0
// A scene, ready to be traced: geometry, materials, lights, camera, and what the file says about film and render.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/diagnostics.h"
#include "base/sampler.h"
#include "colour/xyz.h"
#include "materials/medium.h"
#include "scene/accelerator.h"
#include "scene/camera.h"
#include "scene/integrator_choice.h"
#include "scene/light_selection.h"

namespace iride {

enum class FilterKind { box, triangle, gaussian };

// A layer wanted beside the picture; what names there are is the integrators' matter (integrators/layers.h).
struct LayerRequest {
    std::string name;
    SourceLocation where{};
    std::string key_path = "--aov";
};

struct FilmSettings {
    int width = 256, height = 256;
    FilterKind filter = FilterKind::box;
    float filter_radius = 0.5f;  // pixels
    double exposure = 1;
    Chromaticity white{0.3127, 0.3290};
    int band_count = 0;
    WavelengthRange band_range = visible_range;
    bool half = false;
    std::vector<LayerRequest> aovs{};
};

struct RenderDefaults {
    IntegratorChoice integrator{};
    int spp = 64;
    std::uint64_t seed = 0;
    SamplerKind sampler = SamplerKind::zsobol;
    std::optional<int> max_bounces;
    std::optional<LightSelection> light_selection{};  // absent: the plan decides
};

// A material with what is known of it outside the sampling loop.
struct NamedMaterial {
    std::string name, type;
    std::unique_ptr<Material> material;
    std::string key_path{};  // where the scene file has it
    int line = 0, column = 0;
    std::shared_ptr<Relief const> relief{};  // null: none
    std::optional<ScalarMap> alpha{};        // absent: no holes

    bool looks_at_uv() const { return material->traits.textured || relief || alpha; }
};

// What the plan wants to know of a light's spectrum.
struct LightDescription {
    std::string type;
    SpectralFunction spectrum;
    WavelengthRange nonzero;  // outside it the light is dark
    double luminance;
    std::string group{};  // of lights that are to be told apart in the picture; empty: none
};

struct Scene {
    std::string name, description, hash;  // hash: of the scene file and every file it names
    WavelengthRange wavelengths = visible_range;
    WavelengthGrid grid{};
    VectorDouble origin = VectorDouble::Zero();  // [m] the place in the file that has coordinates 0 here
    CameraSettings camera;
    FilmSettings film;
    RenderDefaults render;
    std::vector<NamedMaterial> materials;
    Medium open_medium;  // fills the place that no body fills
    std::vector<Shape> shapes;
    std::vector<ObjectGeometry> objects;
    std::vector<InstancePlacement> instances;
    std::vector<LightDescription> light_descriptions;
    LightSet lights;
    std::unique_ptr<Accelerator> accelerator;
    std::vector<std::string> remarks;  // the load report: tables shorter than the range and what fills the rest

    Material const& material(int index) const { return *materials[static_cast<std::size_t>(index)].material; }
    Vector centre() const { return (accelerator->lower_bound() + accelerator->upper_bound()) / 2; }
    float radius() const { return (accelerator->upper_bound() - accelerator->lower_bound()).norm() / 2; }
};

// Load a scene file. Throws one InputError with everything that is wrong with it.
std::unique_ptr<Scene> load_scene(std::filesystem::path const& path);

// SCENE of the command line: a file, or the name of a shipped scene. Throws InputError with the nearest name.
std::filesystem::path find_scene(std::string const& file_or_name);
struct ShippedScene {
    std::string name, description;
};
std::vector<ShippedScene> shipped_scenes();

}  // namespace iride
