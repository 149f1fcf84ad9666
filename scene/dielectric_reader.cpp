// SPDX-License-Identifier: Apache-2.0
// Transparent bodies, as a scene file gives them.
#include "materials/dielectric_material.h"
#include "scene/material_readers.h"

namespace iride {

MaterialPointer read_dielectric(SceneBuilder& b, Fields& f) {
    auto const inside = read_complex_index(b, f, "ior");
    auto const outside =
        f.find("exterior_ior") ? read_complex_index(b, f, "exterior_ior") : std::optional<ComplexIndex>(ComplexIndex{});
    if (!inside || !outside) return nullptr;
    for (auto const& [index, key] : {std::pair(&*inside, "ior"), std::pair(&*outside, "exterior_ior")})
        if (index->k.largest(b.scene.wavelengths) > 0)
            f.error_at(key, "this medium absorbs (k > 0): a dielectric is transparent; a metal is a 'conductor'");
    return std::make_unique<DielectricMaterial>(Index(inside->n, b.scene.grid), Index(outside->n, b.scene.grid));
}

}  // namespace iride
