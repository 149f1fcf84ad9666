// SPDX-License-Identifier: Apache-2.0
#include "support/bsdf_models.h"

namespace iride::test {

namespace {

// Normalised: .3 of the light along the normal by the diffuse term, .7 (less in each further lane) by the lobe.
template <HeuristicLobe lobe>
Heuristic<lobe> heuristic(float exponent) {
    auto const per_specular = static_cast<float>(1 / lobe_albedo(lobe, static_cast<double>(exponent)));
    return {Lanes(.3f * inverse_pi), rising_lanes(.7f, -.05f) * per_specular, exponent};
}

}  // namespace

std::vector<NamedModel> heuristic_models() {
    std::vector<NamedModel> models;
    for (float exponent : {0.0f, 1.0f, 20.0f, 300.0f}) {
        int const quadrature = exponent > 100 ? 128 : 32;
        models.push_back({"phong", heuristic<HeuristicLobe::phong>(exponent), quadrature, false, false});
        models.push_back({"blinn-phong", heuristic<HeuristicLobe::blinn_phong>(exponent), quadrature, false, false});
        models.push_back(
            {"modified blinn-phong", heuristic<HeuristicLobe::modified_blinn_phong>(exponent), quadrature});
    }
    return models;
}

}  // namespace iride::test
