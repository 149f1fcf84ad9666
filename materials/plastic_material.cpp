// SPDX-License-Identifier: Apache-2.0
// What a plastic works out before it is hit.
#include "materials/plastic_material.h"

namespace iride {

PlasticMaterial::PlasticMaterial(ReflectanceMap reflectance, SpectralFunction const& n,
                                 SpectralFunction const& optical_depth, float roughness, WavelengthGrid const& grid)
    : Material({.textured = reflectance.varies()}),
      reflectance_(std::move(reflectance)),
      n_(n, grid),
      depth_(optical_depth, grid),
      roughness_(roughness) {
    WavelengthRange const range{static_cast<double>(grid.first_nm),
                                static_cast<double>(grid.first_nm + grid.count - 1)};
    if (roughness > 0)
        albedo_ = std::make_unique<CoatAlbedo const>(Ggx{roughness}, n.smallest(range), n.largest(range));
    TabulatedShape internal;
    double entering = 0;
    for (int i = 0; i < grid.count; ++i) {
        double const nm = grid.first_nm + i, index = n.at(nm), depth = optical_depth.at(nm);
        double const outside = albedo_ ? albedo_->mean(index) : mean_fresnel(index, 0);
        internal.nm.push_back(nm);
        internal.value.push_back(internal_reflectance(index, outside, depth));
        entering += (1 - outside) * std::exp(-depth) / grid.count;
    }
    entering_ = static_cast<float>(entering);
    bool const constant = n.is_constant() && optical_depth.is_constant();
    internal_ = constant ? Reflectance(static_cast<float>(internal.value.front()))
                         : Reflectance(SpectralFunction(std::move(internal), Outside::hold), grid);
}

Bsdf PlasticMaterial::at(SurfacePoint const& point, Wavelengths const& w) const {
    Lanes const n = n_.at(w);
    CoatedBase const coat{n, depth_.at(w), radiance_inside(reflectance_.at(point, w), n, internal_.at(w)), entering_};
    if (albedo_) return RoughPlastic{coat, {roughness_}, albedo_.get()};
    return SmoothPlastic{coat};
}

}  // namespace iride
