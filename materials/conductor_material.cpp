// SPDX-License-Identifier: Apache-2.0
// What a conductor works out before it is hit.
#include "materials/conductor_material.h"

namespace iride {

Interreflection::Interreflection(Facets const& facets, WavelengthGrid const& grid,
                                 std::function<double(double)> const& mean_fresnel) {
    if (facets.is_smooth()) return;
    loss_ = shared_facet_loss(facets);
    TabulatedShape table;
    for (int i = 0; i < grid.count; ++i) {
        double const nm = grid.first_nm + i;
        table.nm.push_back(nm);
        table.value.push_back(multiple_scattering_fresnel(mean_fresnel(nm), static_cast<double>(loss_->mean())));
    }
    multiple_fresnel_ = Reflectance(SpectralFunction(std::move(table), Outside::hold), grid);
}

ConductorMaterial::ConductorMaterial(ComplexIndex const& index, RoughSurface surface, bool multiple_scattering,
                                     WavelengthGrid const& grid)
    : Material({.has_density = !surface.facets.is_smooth(),
                .anisotropic = surface.facets.is_anisotropic(),
                .grain = surface.grain()}),
      plane_{.inside = index},
      n_(index.n, grid),
      k_(index.k, grid),
      facets_(std::move(surface.facets)) {
    if (multiple_scattering)
        interreflection_ =
            Interreflection(facets_, grid, [&](double nm) { return mean_fresnel(index.n.at(nm), index.k.at(nm)); });
}

CoatedConductorMaterial::CoatedConductorMaterial(CoatingTable table, RoughSurface surface, bool multiple_scattering,
                                                 WavelengthGrid const& grid)
    : Material({.has_density = !surface.facets.is_smooth(),
                .filmed = true,
                .anisotropic = surface.facets.is_anisotropic(),
                .grain = surface.grain()}),
      table_(std::move(table)),
      facets_(std::move(surface.facets)) {
    if (multiple_scattering)
        interreflection_ =
            Interreflection(facets_, grid, [&](double nm) { return table_.mean_reflectance(nm - grid.first_nm); });
}

}  // namespace iride
