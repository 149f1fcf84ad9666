// SPDX-License-Identifier: Apache-2.0
// The roughness of a surface, as a scene file gives it.
#include <fmt/format.h>

#include "scene/material_readers.h"

namespace iride {

namespace {

// "roughness": a or [ax, ay]. Nothing after an error; 0 where the surface is smooth.
std::optional<Vector2> read_roughness(Fields& f, bool may_be_smooth) {
    JsonValue const* const value = f.find("roughness");
    if (!value) return Vector2(0, 0);
    std::optional<std::vector<double>> alphas;
    if (value->as<JsonArray>())
        alphas = f.numbers("roughness", 2);
    else if (auto const both = f.number("roughness"))
        alphas = {*both, *both};
    if (!alphas) return std::nullopt;
    bool const smooth = (*alphas)[0] == 0 && (*alphas)[1] == 0;
    for (double const alpha : *alphas)
        if (!(smooth && may_be_smooth) && !(static_cast<float>(alpha) >= smallest_roughness && alpha <= 1)) {
            f.error_at("roughness", fmt::format("found {:g}, allowed: {}0.001 .. 1, or a pair of such numbers", alpha,
                                                may_be_smooth ? "0 (smooth), " : ""));
            return std::nullopt;
        }
    return Vector2(static_cast<float>((*alphas)[0]), static_cast<float>((*alphas)[1]));
}

std::optional<std::vector<FacetComponent>> read_components(Fields& f) {
    JsonValue const& value = *f.find("facets");
    JsonArray const* const array = value.as<JsonArray>();
    if (!array || array->empty() || array->size() > max_facet_components) {
        f.error_at("facets", fmt::format("found {}, but an array of 1 .. {} roughnesses is wanted", value.described(),
                                         max_facet_components));
        return std::nullopt;
    }
    std::vector<FacetComponent> components;
    bool good = true;
    double sum = 0;
    for (std::size_t i = 0; i < array->size(); ++i) {
        Fields one(f.context(), (*array)[i], fmt::format("{}[{}]", f.path("facets"), i));
        double const weight = one.required_number("weight", {.least = 0, .most = 1, .least_excluded = true});
        auto const alpha = one.require("roughness") ? read_roughness(one, false) : std::nullopt;
        one.finish();
        sum += weight;
        good &= alpha.has_value();
        if (alpha) components.push_back({static_cast<float>(weight), alpha->x(), alpha->y()});
    }
    constexpr double rounding = 1e-4;  // of weights written with four digits
    if (std::abs(sum - 1) > rounding) {
        f.error_at("facets", fmt::format("the weights sum to {:g}, allowed: 1", sum));
        return std::nullopt;
    }
    for (FacetComponent& c : components) c.weight = static_cast<float>(static_cast<double>(c.weight) / sum);
    return good ? std::optional(components) : std::nullopt;
}

}  // namespace

std::optional<RoughSurface> read_rough_surface(Fields& f) {
    RoughSurface surface;
    surface.rotation_deg = f.number("rotation_deg").value_or(0);
    if (f.choice("distribution", {"ggx", "beckmann"}).value_or("ggx") == "beckmann")
        surface.facets.shape = FacetShape::beckmann;
    if (f.choice("masking", {"smith", "v-cavity"}).value_or("smith") == "v-cavity")
        surface.facets.masking = Masking::v_cavity;
    if (f.find("facets")) {
        if (f.find("roughness")) {
            f.error_at("facets", "the roughness is given twice: allowed is one of 'facets' and 'roughness'");
            return std::nullopt;
        }
        auto components = read_components(f);
        if (!components) return std::nullopt;
        surface.facets.components = std::move(*components);
        return surface;
    }
    auto const alpha = read_roughness(f, true);
    if (!alpha) return std::nullopt;
    if (alpha->x() > 0) surface.facets.components = {{1, alpha->x(), alpha->y()}};
    return surface;
}

}  // namespace iride
