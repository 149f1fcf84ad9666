// SPDX-License-Identifier: Apache-2.0
// Transparent bodies, as a scene file gives them.
#include "materials/dielectric_material.h"
#include "materials/slab_material.h"
#include "scene/material_readers.h"

namespace iride {

MaterialPointer read_dielectric(SceneBuilder& b, Fields& f) {
    if (f.find("coating")) return read_coated_dielectric(b, f);
    constexpr int most = 1000000;
    auto inside = read_medium(b, f, "ior");
    if (inside) read_scattering(b, f, *inside);
    bool const outside_is_stated = f.find("exterior_ior");
    auto const outside =
        outside_is_stated ? read_medium_of_index(b, f, "exterior_ior") : std::optional<Medium>(Medium{});
    auto const priority = f.integer("priority", -most, most);
    if (priority && outside_is_stated)
        f.error_at("exterior_ior",
                   "found together with 'priority', by which a body finds what is around it; allowed: one of them");
    auto surface = read_rough_surface(f);
    if (!inside || !outside || !surface) return nullptr;
    bool const needs_an_index = priority || !surface->facets.is_smooth();
    auto const has_zero = [&](Medium const& m) { return !(m.index.n.smallest(b.scene.wavelengths) > 0); };
    if (needs_an_index && (has_zero(*inside) || has_zero(*outside))) {
        f.error_at(has_zero(*inside) ? "ior" : "exterior_ior",
                   "n reaches 0, under a rough surface or beside other media: allowed: above 0");
        return nullptr;
    }
    return std::make_unique<DielectricMaterial>(Body{*inside, *outside, priority, outside_is_stated},
                                                std::move(*surface), b.scene.wavelengths);
}

MaterialPointer read_slab(SceneBuilder& b, Fields& f) {
    auto const medium = read_medium(b, f, "ior");
    double const thickness = f.required_number("thickness", positive()) * b.length_unit_m;
    if (!medium) return nullptr;
    return std::make_unique<SlabMaterial>(*medium, static_cast<float>(thickness));
}

}  // namespace iride
