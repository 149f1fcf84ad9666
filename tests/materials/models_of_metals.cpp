// SPDX-License-Identifier: Apache-2.0
#include "support/bsdf_models.h"
#include "support/conductors.h"

namespace iride::test {

namespace {

// 60 nm of rutile-like oxide on a titanium-like metal, at wavelengths spread over the visible.
CoatedFresnel oxide_on_metal() {
    constexpr WavelengthRange range{400, 700};
    static WavelengthGrid const grid = WavelengthGrid::covering(range);
    static std::vector<CoatingLayer> const oxide{
        {{SpectralFunction::constant(2.4), SpectralFunction::constant(0)}, 60}};
    static CoatingTable const table(oxide, {SpectralFunction::constant(2.7), SpectralFunction::constant(3.8)}, grid);
    return {&table, table.row_of(WavelengthSampler(range, SpectralFunction::constant(1), grid).sample(.1f))};
}

}  // namespace

std::vector<NamedModel> metal_models() {
    Lanes const n = rising_lanes(.15f, .2f), k = rising_lanes(3, .1f);
    std::vector<NamedModel> models{{"rough coated conductor", RoughCoatedConductor{oxide_on_metal(), {.3f}}}};
    for (float alpha : {.05f, .2f, .5f, 1.0f}) {
        int const quadrature = alpha < .1f ? 200 : 32;
        models.push_back({"rough conductor", RoughConductor{n, k, {alpha}}, quadrature});
        models.push_back({"interreflecting conductor", interreflecting(n, k, alpha), quadrature});
    }
    return models;
}

}  // namespace iride::test
