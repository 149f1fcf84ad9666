// SPDX-License-Identifier: Apache-2.0
// Materials of a scene file.
#include <array>

#include "materials/diffuse_material.h"
#include "scene/material_readers.h"

namespace iride {

namespace {

constexpr std::array<MaterialEntry, 5> table{{
    {"diffuse", "Lambert's law, on both sides", read_diffuse},
    {"conductor", "a metal by its n + ik, smooth or GGX rough, bare or under thin films", read_conductor},
    {"dielectric", "a smooth transparent body, dispersive where its index is, absorbing, nested by priority",
     read_dielectric},
    {"slab", "a thin pane of a transparent medium, as one surface", read_slab},
    {"black", "absorbs everything", read_black},
}};

}  // namespace

std::span<MaterialEntry const> material_entries() { return table; }

int read_material(SceneBuilder& b, JsonValue const& value, std::string const& path, std::string const& name) {
    Fields fields(b.context, value, path);
    MaterialEntry const* const entry = find_entry(fields, material_entries());
    if (!entry) return 0;
    MaterialPointer material = entry->reader(b, fields);
    fields.finish();
    if (!material) material = std::make_unique<BlackMaterial>();  // an error was reported: never rendered
    b.scene.materials.push_back({name, entry->name, std::move(material), path, value.line, value.column});
    return static_cast<int>(b.scene.materials.size()) - 1;
}

}  // namespace iride
