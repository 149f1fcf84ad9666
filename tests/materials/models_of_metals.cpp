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
    Lanes const n = rising_lanes(.15f, .2f), k = rising_lanes(3, .1f), white_n(1e-3f), white_k(1000);
    std::vector<NamedModel> models;
    auto const add = [&](std::string const& name, Bsdf const& bsdf, float alpha, bool white = false) {
        models.push_back({.name = name + " " + std::to_string(alpha),
                          .bsdf = bsdf,
                          .white = white,
                          .width = alpha < .4f ? 2 * alpha : 2});
    };
    FacetLoss const& loss = facet_loss(Facets::ggx(.3f, .3f));
    add("coated, single scattering", RoughCoatedConductor{oxide_on_metal(), .3f}, .3f);
    add("coated", RoughCoatedConductor{oxide_on_metal(), .3f, &loss, Lanes(.2f)}, .3f);
    add("single scattering", RoughConductor{n, k, .2f}, .2f);
    for (float alpha : {.001f, .05f, .2f, .5f, 1.0f}) {
        add("ggx", interreflecting(n, k, alpha), alpha);
        add("white ggx", interreflecting(white_n, white_k, alpha), alpha, true);
    }
    using Components = std::vector<FacetComponent>;
    Components const brushed{{1, .1f, .4f}}, several{{.5f, .1f, .1f}, {.3f, .3f, .6f}, {.2f, 1, 1}};
    auto const add_all = [&](std::string const& name, Facets const& facets, float alpha) {
        add(name, interreflecting(n, k, facets), alpha);
        add("white " + name, interreflecting(white_n, white_k, facets), alpha, true);
    };
    for (Masking const masking : {Masking::smith, Masking::v_cavity}) {
        std::string const suffix = masking == Masking::smith ? ", smith" : ", v-cavity";
        for (float alpha : {.001f, .1f, .6f})
            add_all("beckmann" + suffix, {{{1, alpha, alpha}}, FacetShape::beckmann, masking}, alpha);
        add_all("brushed ggx" + suffix, {brushed, FacetShape::ggx, masking}, .1f);
        add_all("brushed beckmann" + suffix, {brushed, FacetShape::beckmann, masking}, .1f);
        add_all("mixed ggx" + suffix, {several, FacetShape::ggx, masking}, .2f);
        add_all("mixed beckmann" + suffix, {several, FacetShape::beckmann, masking}, .2f);
    }
    return models;
}

}  // namespace iride::test
