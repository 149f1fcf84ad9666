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
    if (priority && !surface->facets.is_smooth())
        f.error_at("priority", "a rough surface is prepared for one medium outside: give it by 'exterior_ior'");
    std::pair<double, double> eta{infinity, 0};
    for (int i = 0; i < b.scene.grid.count; ++i) {
        double const nm =
            std::clamp<double>(b.scene.grid.first_nm + i, b.scene.wavelengths.min_nm, b.scene.wavelengths.max_nm);
        double const ratio = inside->index.n.at(nm) / outside->index.n.at(nm);
        eta = {std::min(eta.first, ratio), std::max(eta.second, ratio)};
    }
    if (!surface->facets.is_smooth() && !(eta.first > 0 && std::isfinite(eta.second))) {
        f.error_at("ior", "n reaches 0, under a rough surface: allowed: above 0");
        return nullptr;
    }
    return std::make_unique<DielectricMaterial>(Body{*inside, *outside, priority, outside_is_stated},
                                                std::move(*surface), eta);
}

MaterialPointer read_slab(SceneBuilder& b, Fields& f) {
    auto const medium = read_medium(b, f, "ior");
    double const thickness = f.required_number("thickness", positive()) * b.length_unit_m;
    if (!medium) return nullptr;
    return std::make_unique<SlabMaterial>(*medium, static_cast<float>(thickness));
}

}  // namespace iride
