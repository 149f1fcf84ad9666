// SPDX-License-Identifier: Apache-2.0
// Rough metals for tests, without a scene: the losses of facets are tabulated once and kept.
#pragma once

#include <map>

#include "materials/conductor.h"

namespace iride::test {

// Facets for closures, which point to them.
inline Facets const& kept_facets(Facets const& facets) {
    static std::map<Facets, int> all;
    return all.try_emplace(facets).first->first;
}

inline FacetLoss const& facet_loss(Facets const& facets) {
    static std::map<Facets, FacetLoss> tables;
    return tables.try_emplace(facets, facets).first->second;
}

inline Lanes multiple_fresnel(Lanes n, Lanes k, FacetLoss const& loss) {
    Lanes multiple;
    for (int i = 0; i < lane_count; ++i) {
        double const mean = mean_fresnel(static_cast<double>(n[i]), static_cast<double>(k[i]));
        multiple.set(i, static_cast<float>(multiple_scattering_fresnel(mean, static_cast<double>(loss.mean()))));
    }
    return multiple;
}

// With light of several bounces.
inline RoughConductor interreflecting(Lanes n, Lanes k, float alpha) {
    FacetLoss const& loss = facet_loss(Facets::ggx(alpha, alpha));
    return {n, k, alpha, &loss, multiple_fresnel(n, k, loss)};
}
inline RoughMetal<BareFresnel, FacetsOfMaterial> interreflecting(Lanes n, Lanes k, Facets const& facets) {
    FacetLoss const& loss = facet_loss(facets);
    return {n, k, &kept_facets(facets), &loss, multiple_fresnel(n, k, loss)};
}

}  // namespace iride::test
