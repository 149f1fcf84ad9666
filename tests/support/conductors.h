// SPDX-License-Identifier: Apache-2.0
// Rough metals for tests, without a scene: the albedo table of a roughness is made once and kept.
#pragma once

#include <map>

#include "materials/conductor.h"

namespace iride::test {

inline GgxAlbedo const& ggx_albedo(float alpha) {
    static std::map<float, GgxAlbedo> tables;
    return tables.try_emplace(alpha, Ggx{alpha}).first->second;
}

inline InterreflectingConductor interreflecting(Lanes n, Lanes k, float alpha) {
    GgxAlbedo const& albedo = ggx_albedo(alpha);
    Lanes multiple;
    for (int i = 0; i < lane_count; ++i) {
        double const mean = mean_fresnel(static_cast<double>(n[i]), static_cast<double>(k[i]));
        multiple.set(i, static_cast<float>(multiple_scattering_fresnel(mean, static_cast<double>(albedo.mean_loss()))));
    }
    return {n, k, multiple, {alpha}, &albedo};
}

}  // namespace iride::test
