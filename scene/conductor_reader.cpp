// SPDX-License-Identifier: Apache-2.0
// Metals, bare and coated, as a scene file gives them.
#include "materials/conductor_material.h"
#include "materials/roughness_mapped_conductor.h"
#include "scene/material_readers.h"
#include "scene/texture_readers.h"

namespace iride {

namespace {

MaterialPointer read_coated_conductor(SceneBuilder& b, Fields& f, std::optional<ComplexIndex> const& metal,
                                      RoughSurface const& surface, bool multiple_scattering) {
    auto const layers = read_films(b, f, "coating");
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
    auto const roughness = read_scalar_map(b, f, "roughness", {"roughness", between(smallest_roughness, 1)});
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
