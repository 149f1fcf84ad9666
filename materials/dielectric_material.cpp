// SPDX-License-Identifier: Apache-2.0
#include "materials/dielectric_material.h"

namespace iride {

DielectricMaterial::DielectricMaterial(Body body, RoughSurface surface, WavelengthRange const& sampled)
    : Material({.two_sided = false,
                .dispersive = !body.inside.n.is_constant() || !body.outside.n.is_constant(),
                .has_density = !surface.facets.is_smooth(),
                .transmits = true,
                .anisotropic = surface.facets.is_anisotropic(),
                .grain = surface.grain()}),
      body_(std::move(body)),
      plane_{.outside = body_.outside.index, .inside = body_.inside.index},
      facets_(std::move(surface.facets)),
      sampled_(sampled) {
    if (!body_.priority) prepare_for(std::array{static_cast<Medium const*>(&body_.outside)});
}

// What interpolates between media would be worst where eta passes 1: each medium has a range of its own.
void DielectricMaterial::prepare_for(std::span<Medium const* const> outside) {
    if (facets_.is_smooth()) return;
    std::vector<std::pair<double, double>> ranges;
    for (Medium const* const medium : outside) {
        auto& [least, most] = ranges.emplace_back(infinity, 0);
        for (double nm = sampled_.min_nm; nm <= sampled_.max_nm; ++nm) {
            double const eta = body_.inside.index.n.at(nm) / medium->index.n.at(nm);
            least = std::min(least, eta);
            most = std::max(most, eta);
        }
    }
    std::ranges::sort(ranges);
    losses_.clear();
    for (std::size_t i = 0; i < ranges.size();) {
        auto [least, most] = ranges[i];
        for (++i; i < ranges.size() && ranges[i].first <= most; ++i) most = std::max(most, ranges[i].second);
        losses_.emplace_back(facets_, least, most);
    }
}

BoundaryLoss const& DielectricMaterial::loss_of(float eta) const {
    auto const nearest = std::ranges::find_if(losses_, [&](BoundaryLoss const& loss) { return eta <= loss.eta_max(); });
    return nearest == losses_.end() ? losses_.back() : *nearest;
}

}  // namespace iride
