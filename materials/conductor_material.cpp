// SPDX-License-Identifier: Apache-2.0
// What a conductor works out before it is hit.
#include "materials/conductor_material.h"

namespace iride {

ConductorMaterial::ConductorMaterial(ComplexIndex const& index, float roughness, bool multiple_scattering,
                                     WavelengthGrid const& grid)
    : Material({.has_density = roughness > 0}), n_(index.n, grid), k_(index.k, grid), roughness_(roughness) {
    if (roughness == 0 || !multiple_scattering) return;
    albedo_ = std::make_unique<GgxAlbedo const>(Ggx{roughness});
    auto const fresnel_at = [&](double nm) {
        return multiple_scattering_fresnel(mean_fresnel(index.n.at(nm), index.k.at(nm)),
                                           static_cast<double>(albedo_->mean_loss()));
    };
    TabulatedShape table;
    for (int i = 0; i < grid.count; ++i) {
        table.nm.push_back(grid.first_nm + i);
        table.value.push_back(fresnel_at(table.nm.back()));
    }
    multiple_fresnel_ = Reflectance(SpectralFunction(std::move(table), Outside::hold), grid);
}

}  // namespace iride
