// SPDX-License-Identifier: Apache-2.0
// Metals, bare and coated, as a scene file gives them.
#include <fmt/format.h>

#include "materials/conductor_material.h"
#include "materials/roughness_mapped_conductor.h"
#include "scene/material_readers.h"
#include "scene/texture_readers.h"

namespace iride {

namespace {

// Where a plane wave is to be followed through, n = 0 is no medium.
void refuse_zero_index(SceneBuilder& b, Fields& f, ComplexIndex const& index) {
    if (!(index.n.smallest(b.scene.wavelengths) > 0))
        f.error_at("ior", "n reaches 0, under a coating or in it: allowed: above 0");
}

// Layers from outside to inside; nothing after an error.
std::optional<std::vector<CoatingLayer>> read_coating(SceneBuilder& b, Fields& f) {
    JsonValue const& value = *f.find("coating");
    JsonArray const* const array = value.as<JsonArray>();
    if (!array || array->empty() || array->size() > max_coating_layers) {
        f.error_at("coating", fmt::format("found {}, but an array of 1 .. {} layers is wanted", value.described(),
                                          max_coating_layers));
        return std::nullopt;
    }
    std::size_t const errors_before = b.context.diagnostics.size();
    std::vector<CoatingLayer> layers;
    for (std::size_t i = 0; i < array->size(); ++i) {
        Fields layer(b.context, (*array)[i], fmt::format("{}[{}]", f.path("coating"), i));
        auto const ior = read_complex_index(b, layer, "ior");
        double const thickness = layer.required_number("thickness_nm", at_least(0));
        layer.finish();
        if (!ior) continue;
        refuse_zero_index(b, layer, *ior);
        layers.push_back({*ior, thickness});
    }
    if (b.context.diagnostics.size() > errors_before) return std::nullopt;
    return layers;
}

MaterialPointer read_coated_conductor(SceneBuilder& b, Fields& f, std::optional<ComplexIndex> const& metal,
                                      RoughSurface const& surface, bool multiple_scattering) {
    auto const layers = read_coating(b, f);
    if (metal) refuse_zero_index(b, f, *metal);
    if (!metal || !layers) return nullptr;
    MaterialPointer material;
    b.context.guarded(*f.find("coating"), f.path("coating"), [&] {
        material = std::make_unique<CoatedConductorMaterial>(CoatingTable(*layers, *metal, b.scene.grid), surface,
                                                             multiple_scattering, b.scene.grid);
    });
    return material;
}

MaterialPointer read_roughness_mapped(SceneBuilder& b, Fields& f, std::optional<ComplexIndex> const& ior) {
    auto const roughness = read_scalar_map(b, f, "roughness", {"roughness", between(1e-3, 1)});
    if (f.find("coating")) f.error_at("coating", "a coated metal has one roughness, a number: no map");
    bool const multiple_scattering = f.boolean("multiple_scattering").value_or(true);
    if (!ior || !roughness) return nullptr;
    return std::make_unique<RoughnessMappedConductor>(*ior, *roughness, multiple_scattering, b.scene.grid);
}

}  // namespace

MaterialPointer read_conductor(SceneBuilder& b, Fields& f) {
    auto const ior = read_complex_index(b, f, "ior");
    if (JsonValue const* const value = f.find("roughness"); value && value->as<JsonObject>())
        return read_roughness_mapped(b, f, ior);
    auto const surface = read_rough_surface(f);
    bool const multiple_scattering = f.boolean("multiple_scattering").value_or(true);
    if (f.find("coating"))
        return read_coated_conductor(b, f, ior, surface.value_or(RoughSurface()), multiple_scattering);
    if (!ior || !surface) return nullptr;
    return std::make_unique<ConductorMaterial>(*ior, *surface, multiple_scattering, b.scene.grid);
}

}  // namespace iride
