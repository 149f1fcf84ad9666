// SPDX-License-Identifier: Apache-2.0
// Transparent bodies, as a scene file gives them.
#include "materials/dielectric_material.h"
#include "materials/slab_material.h"
#include "scene/material_readers.h"

namespace iride {

MaterialPointer read_dielectric(SceneBuilder& b, Fields& f) {
    if (f.find("coating")) return read_coated_dielectric(b, f);
    constexpr int most = 1000000;
    auto const inside = read_medium(b, f, "ior");
    bool const outside_is_stated = f.find("exterior_ior");
    auto const outside =
        outside_is_stated ? read_medium_of_index(b, f, "exterior_ior") : std::optional<Medium>(Medium{});
    auto const priority = f.integer("priority", -most, most);
    if (priority && outside_is_stated)
        f.error_at("exterior_ior",
                   "found together with 'priority', by which a body finds what is around it; allowed: one of them");
    if (!inside || !outside) return nullptr;
    return std::make_unique<DielectricMaterial>(Body{*inside, *outside, priority, outside_is_stated});
}

MaterialPointer read_slab(SceneBuilder& b, Fields& f) {
    auto const medium = read_medium(b, f, "ior");
    double const thickness = f.required_number("thickness", positive()) * b.length_unit_m;
    if (!medium) return nullptr;
    return std::make_unique<SlabMaterial>(*medium, static_cast<float>(thickness));
}

}  // namespace iride
