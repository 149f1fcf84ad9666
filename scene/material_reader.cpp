// SPDX-License-Identifier: Apache-2.0
// Materials of a scene file.
#include <fmt/format.h>

#include <array>

#include "scene/readers.h"

namespace iride {

namespace {

using Read = std::unique_ptr<Material const>;

Read read_diffuse(SceneBuilder& b, Fields& f) {
    auto const reflectance = read_spectrum(b, f, "reflectance", reflectance_kind);
    if (!reflectance) return nullptr;
    return std::make_unique<DiffuseMaterial>(Reflectance(*reflectance, b.scene.grid));
}

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

Read read_coated_conductor(SceneBuilder& b, Fields& f, std::optional<ComplexIndex> const& metal, float roughness) {
    auto const layers = read_coating(b, f);
    if (metal) refuse_zero_index(b, f, *metal);
    if (!metal || !layers) return nullptr;
    Read material;
    b.context.guarded(*f.find("coating"), f.path("coating"), [&] {
        material = std::make_unique<CoatedConductorMaterial>(CoatingTable(*layers, *metal, b.scene.grid), roughness);
    });
    return material;
}

Read read_conductor(SceneBuilder& b, Fields& f) {
    auto const ior = read_complex_index(b, f, "ior");
    double const roughness = f.number("roughness", between(0, 1)).value_or(0);
    if (roughness > 0 && roughness < 1e-3) f.error_at("roughness", "allowed: 0 (a mirror) or 0.001 .. 1 (GGX alpha)");
    if (f.find("coating")) return read_coated_conductor(b, f, ior, static_cast<float>(roughness));
    bool const multiple_scattering = f.boolean("multiple_scattering").value_or(true);
    if (!ior || !(roughness == 0 || roughness >= 1e-3)) return nullptr;
    return std::make_unique<ConductorMaterial>(*ior, static_cast<float>(roughness), multiple_scattering, b.scene.grid);
}

Read read_dielectric(SceneBuilder& b, Fields& f) {
    auto const inside = read_complex_index(b, f, "ior");
    auto const outside =
        f.find("exterior_ior") ? read_complex_index(b, f, "exterior_ior") : std::optional<ComplexIndex>(ComplexIndex{});
    if (!inside || !outside) return nullptr;
    for (auto const& [index, key] : {std::pair(&*inside, "ior"), std::pair(&*outside, "exterior_ior")})
        if (index->k.largest(b.scene.wavelengths) > 0)
            f.error_at(key, "this medium absorbs (k > 0): a dielectric is transparent; a metal is a 'conductor'");
    return std::make_unique<DielectricMaterial>(Index(inside->n, b.scene.grid), Index(outside->n, b.scene.grid));
}

Read read_black(SceneBuilder&, Fields&) { return std::make_unique<BlackMaterial>(); }

constexpr std::array<MaterialEntry, 4> table{{
    {"diffuse", "Lambert's law, on both sides", read_diffuse},
    {"conductor", "a metal by its n + ik, smooth or GGX rough, bare or under thin films", read_conductor},
    {"dielectric", "a smooth transparent body, dispersive where its index is", read_dielectric},
    {"black", "absorbs everything", read_black},
}};

}  // namespace

std::span<MaterialEntry const> material_entries() { return table; }

int read_material(SceneBuilder& b, JsonValue const& value, std::string const& path, std::string const& name) {
    Fields fields(b.context, value, path);
    MaterialEntry const* const entry = find_entry(fields, material_entries());
    if (!entry) return 0;
    Read material = entry->reader(b, fields);
    fields.finish();
    if (!material) material = std::make_unique<BlackMaterial>();  // an error was reported: never rendered
    b.scene.materials.push_back({name, entry->name, std::move(material)});
    return static_cast<int>(b.scene.materials.size()) - 1;
}

}  // namespace iride
