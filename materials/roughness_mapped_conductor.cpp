// SPDX-License-Identifier: Apache-2.0
#include "materials/roughness_mapped_conductor.h"

namespace iride {

RoughnessMappedConductor::RoughnessMappedConductor(ComplexIndex const& index, ScalarMap roughness,
                                                   bool multiple_scattering, WavelengthGrid const& grid)
    : Material({.textured = true}), n_(index.n, grid), k_(index.k, grid), roughness_(std::move(roughness)) {
    if (!multiple_scattering) return;
    TabulatedShape table;
    for (int i = 0; i < grid.count; ++i) {
        table.nm.push_back(grid.first_nm + i);
        table.value.push_back(mean_fresnel(index.n.at(table.nm.back()), index.k.at(table.nm.back())));
    }
    mean_fresnel_ = Reflectance(SpectralFunction(std::move(table), Outside::hold), grid);

    constexpr float step = 0.03f;  // wanted ratio of one roughness to the next, less 1
    constexpr int most_levels = 64;
    auto const [least, most] = roughness_.range();
    float const span = std::log(most / least);
    int const levels = std::clamp(1 + static_cast<int>(std::ceil(span / std::log1p(step))), 1, most_levels);
    first_ = std::log(least);
    per_level_ = levels > 1 ? span / static_cast<float>(levels - 1) : 1;
    for (int i = 0; i < levels; ++i) {
        float const alpha = std::exp(first_ + per_level_ * static_cast<float>(i));
        levels_.push_back({alpha, shared_facet_loss(Facets::ggx(alpha, alpha))});
    }
}

RoughnessMappedConductor::Level const& RoughnessMappedConductor::nearest(float roughness) const {
    auto const i = std::lround((std::log(roughness) - first_) / per_level_);
    return levels_[static_cast<std::size_t>(std::clamp(i, 0l, static_cast<long>(levels_.size()) - 1))];
}

Bsdf RoughnessMappedConductor::at(SurfacePoint const& point, Wavelengths const& w) const {
    float const roughness = roughness_.at(point);
    BareFresnel const fresnel{n_.at(w), k_.at(w)};
    if (levels_.empty()) return RoughConductor{fresnel, roughness};
    Level const& level = nearest(roughness);
    // F_ms of materials/conductor.h, per lane.
    Lanes const mean = mean_fresnel_.at(w);
    float const loss = level.loss->mean();
    Lanes const multiple = mean * mean * (1 - loss) / (Lanes(1) - mean * loss);
    return RoughConductor{fresnel, level.roughness, level.loss.get(), multiple};
}

}  // namespace iride
