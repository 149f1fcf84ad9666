// SPDX-License-Identifier: Apache-2.0
// Materials of a scene file.
#include <fmt/format.h>

#include <array>

#include "materials/diffuse_material.h"
#include "scene/material_readers.h"
#include "scene/texture_readers.h"

namespace iride {

namespace {

constexpr auto table = std::to_array<MaterialEntry>({
    {"diffuse", "Lambert's law, on both sides", read_diffuse},
    {"conductor", "a metal by its n + ik, smooth or rough, bare or under thin films", read_conductor},
    {"dielectric",
     "a transparent body, smooth or rough, dispersive where its index is, absorbing, nested by priority, or under thin "
     "films",
     read_dielectric},
    {"slab", "a thin pane of a transparent medium, as one surface", read_slab},
    {"film", "thin films between equal media: a soap film", read_film},
    {"black", "absorbs everything", read_black},
    {"oren-nayar", "a rough diffuse surface", read_oren_nayar},
    {"plastic", "a dielectric coat, smooth or GGX rough, over a diffuse base", read_plastic},
    {"mixture", "other materials by weights", read_mixture},
    {"two-sided", "one material in front and another behind", read_two_sided},
    {"phong", "heuristic: a cosine power about the mirror image", read_phong},
    {"blinn-phong", "heuristic: a cosine power of the half vector", read_blinn_phong},
    {"modified-blinn-phong", "heuristic: the same without the division by the cosine", read_modified_blinn_phong},
});

}  // namespace

std::span<MaterialEntry const> material_entries() { return table; }

namespace {

// Materials inside materials: deeper than this is a mistake.
constexpr int deepest = 32;

int add_material(SceneBuilder& b, NamedMaterial material) {
    if (!material.material) material.material = std::make_unique<BlackMaterial>();  // an error was reported
    b.scene.materials.push_back(std::move(material));
    return static_cast<int>(b.scene.materials.size()) - 1;
}

int unknown_material(SceneBuilder& b) { return add_material(b, {"", "black", nullptr, "", 0, 0}); }

}  // namespace

int read_material(SceneBuilder& b, JsonValue const& value, std::string const& path, std::string const& name) {
    Fields fields(b.context, value, path);
    MaterialEntry const* const entry = find_entry(fields, material_entries());
    if (!entry) return unknown_material(b);
    MaterialPointer material = entry->reader(b, fields);
    SurfaceDetail detail = read_surface_detail(b, fields);
    if (detail.alpha && material && !material->traits.two_sided)
        fields.error_at("alpha", "a transparent body has no holes: a ray would be inside without having entered");
    fields.finish();
    return add_material(b, {name, entry->name, std::move(material), path, value.line, value.column,
                            std::move(detail.relief), std::move(detail.alpha)});
}

int read_named_material(SceneBuilder& b, std::string const& name) {
    NamedSource& source = b.named_materials.at(name);
    if (source.index >= 0) return source.index;
    source.under_way = true;
    source.index = read_material(b, *source.value, "materials." + name, name);
    source.under_way = false;
    return source.index;
}

int read_material_under(SceneBuilder& b, Fields& f, std::string const& key) {
    JsonValue const* const value = f.require(key);
    if (!value) return unknown_material(b);
    if (b.material_depth == deepest) {
        f.error_at(key, fmt::format("materials are made of others more than {} deep", deepest));
        return unknown_material(b);
    }
    ++b.material_depth;
    int index = -1;
    if (value->as<JsonObject>()) {
        index = read_material(b, *value, f.path(key), f.path(key));
    } else if (auto const name = f.text(key)) {
        auto const found = b.named_materials.find(*name);
        if (found == b.named_materials.end()) {
            std::vector<std::string> names;
            for (auto const& entry : b.named_materials) names.push_back(entry.first);
            f.error_at(key, fmt::format("unknown material '{}'{}", *name, suggestion(*name, names)));
        } else if (found->second.under_way) {
            f.error_at(key, fmt::format("material '{}' is made of itself", *name));
        } else {
            index = read_named_material(b, *name);
        }
    }
    --b.material_depth;
    return index >= 0 ? index : unknown_material(b);
}

}  // namespace iride
