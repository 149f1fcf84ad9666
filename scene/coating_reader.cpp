// SPDX-License-Identifier: Apache-2.0
// Thin films as a scene file gives them: on a metal, on glass, or alone.
#include <fmt/format.h>

#include "materials/coated_dielectric_material.h"
#include "scene/material_readers.h"

namespace iride {

namespace {

std::optional<ComplexIndex> const air(ComplexIndex{});

std::optional<ComplexIndex> read_transparent_index(SceneBuilder& b, Fields& f, std::string const& key) {
    auto const index = read_complex_index(b, f, key);
    if (index && index->k.largest(b.scene.wavelengths) > 0)
        f.error_at(key, "this medium absorbs (k > 0): light passes through transparent media alone");
    return index;
}

}  // namespace

void refuse_zero_index(SceneBuilder& b, Fields& f, ComplexIndex const& index) {
    if (!(index.n.smallest(b.scene.wavelengths) > 0))
        f.error_at("ior", "n reaches 0, under a coating or in it: allowed: above 0");
}

std::optional<std::vector<CoatingLayer>> read_films(SceneBuilder& b, Fields& f, std::string const& key) {
    JsonValue const* const value = f.require(key);
    if (!value) return std::nullopt;
    JsonArray const* const array = value->as<JsonArray>();
    if (!array || array->empty() || array->size() > max_coating_layers) {
        f.error_at(key, fmt::format("found {}, but an array of 1 .. {} layers is wanted", value->described(),
                                    max_coating_layers));
        return std::nullopt;
    }
    std::size_t const errors_before = b.context.diagnostics.size();
    std::vector<CoatingLayer> layers;
    for (std::size_t i = 0; i < array->size(); ++i) {
        Fields layer(b.context, (*array)[i], fmt::format("{}[{}]", f.path(key), i));
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

MaterialPointer read_coated_dielectric(SceneBuilder& b, Fields& f) {
    auto const layers = read_films(b, f, "coating");
    auto const inside = read_transparent_index(b, f, "ior");
    auto const outside = f.find("exterior_ior") ? read_transparent_index(b, f, "exterior_ior") : air;
    if (!layers || !inside || !outside) return nullptr;
    MaterialPointer material;
    b.context.guarded(*f.find("coating"), f.path("coating"), [&] {
        material = std::make_unique<CoatedDielectricMaterial>(CoatingTable(*layers, *inside, b.scene.grid, *outside),
                                                              b.scene.grid);
    });
    return material;
}

MaterialPointer read_film(SceneBuilder& b, Fields& f) {
    auto const layers = read_films(b, f, "layers");
    auto const around = f.find("exterior_ior") ? read_transparent_index(b, f, "exterior_ior") : air;
    if (!layers || !around) return nullptr;
    MaterialPointer material;
    b.context.guarded(*f.find("layers"), f.path("layers"), [&] {
        material = std::make_unique<FilmMaterial>(CoatingTable(*layers, *around, b.scene.grid, *around));
    });
    return material;
}

}  // namespace iride
