// SPDX-License-Identifier: Apache-2.0
#include "support/bsdf_models.h"
#include "support/conductors.h"

namespace iride::test {

std::vector<NamedModel> glass_models() {
    std::vector<NamedModel> models;
    auto const add = [&](std::string const& name, Facets const& facets, float alpha, Lanes const& index) {
        static std::vector<std::unique_ptr<BoundaryLoss const>> losses;
        double const least = -static_cast<double>(largest(-index).value),
                     most = static_cast<double>(largest(index).value);
        losses.push_back(std::make_unique<BoundaryLoss const>(facets, least, most));
        BoundaryLoss const* const loss = losses.back().get();
        auto const with = [=, &kept = kept_facets(facets)](Lanes const& n) -> Bsdf {
            if (kept.is_plain()) return RoughDielectric<Ggx>{n, Lanes(1), kept.plain(), loss};
            return RoughDielectric<FacetsOfMaterial>{n, Lanes(1), {&kept}, loss};
        };
        auto const rotated = [=](int hero) {
            Lanes n;
            for (int i = 0; i < lane_count; ++i) n.set(i, index[(i + hero) % lane_count]);
            return with(n);
        };
        models.push_back({.name = name + " " + std::to_string(alpha),
                          .bsdf = with(index),
                          .quadrature = alpha < 1 ? 24 : 96,  // refraction ends with an edge, the higher the rougher
                          .white = true,
                          .width = alpha < .4f ? 2 * alpha : 2,
                          .index_below = index,
                          .with_hero = rotated});
    };
    for (float alpha : {.001f, .05f, .3f, 1.0f}) add("rough glass", Facets::ggx(alpha, alpha), alpha, Lanes(1.5f));
    add("dispersive glass", Facets::ggx(.1f, .1f), .1f, rising_lanes(1.5f, .03f));
    add("water in glass", Facets::ggx(.4f, .4f), .4f, rising_lanes(.8f, .02f));
    add("beckmann glass", {{{1, .3f, .3f}}, FacetShape::beckmann}, .3f, Lanes(1.5f));
    add("brushed glass", Facets::ggx(.1f, .3f), .1f, Lanes(1.5f));
    add("v-cavity glass", {{{1, .2f, .2f}}, FacetShape::ggx, Masking::v_cavity}, .2f, Lanes(1.5f));
    return models;
}

}  // namespace iride::test
