// SPDX-License-Identifier: Apache-2.0
// Materials made of others, as a scene file gives them: mixtures and two-sided ones.
#include <fmt/format.h>

#include <cmath>

#include "materials/mixture_material.h"
#include "scene/material_readers.h"

namespace iride {

namespace {

constexpr double sum_tolerance = 1e-6;  // of weights written with six digits
constexpr std::size_t most_parts = 64;

// The material under `key`, fit to be part of another; null after an error.
Material const* read_part(SceneBuilder& b, Fields& f, std::string const& key) {
    std::size_t const errors_before = b.context.diagnostics.size();
    NamedMaterial const& part = b.scene.materials[static_cast<std::size_t>(read_material_under(b, f, key))];
    if (!part.material->traits.two_sided)
        f.error_at(key, "a transparent body has an inside and cannot be part of another material");
    if (part.relief || part.alpha)
        f.error_at(key, "'bump', 'normal_map' and 'alpha' of a part have no effect: put them on what is made of it");
    return b.context.diagnostics.size() > errors_before ? nullptr : part.material.get();
}

}  // namespace

MaterialPointer read_mixture(SceneBuilder& b, Fields& f) {
    JsonValue const* const value = f.require("parts");
    if (!value) return nullptr;
    JsonArray const* const array = value->as<JsonArray>();
    if (!array || array->empty() || array->size() > most_parts) {
        f.error_at("parts",
                   fmt::format("found {}, but an array of 1 .. {} parts is wanted", value->described(), most_parts));
        return nullptr;
    }
    std::vector<MixtureMaterial::Part> parts;
    Material const* brushed = nullptr;  // the last part with a grain: a mixture has one frame
    double sum = 0;
    bool good = true;
    for (std::size_t i = 0; i < array->size(); ++i) {
        Fields g(b.context, (*array)[i], fmt::format("{}[{}]", f.path("parts"), i));
        std::size_t const errors_before = b.context.diagnostics.size();
        Material const* const material = read_part(b, g, "material");
        double const weight = g.required_number("weight", between(0, 1));
        g.finish();
        if (material && material->traits.anisotropic) {
            if (brushed && brushed->traits.grain != material->traits.grain)
                g.error_at("material", "brushed another way than a part before: their 'rotation_deg' must be equal");
            brushed = material;
        }
        good = good && material && b.context.diagnostics.size() == errors_before;
        parts.push_back({material, weight});
        sum += weight;
    }
    if (!good) return nullptr;
    if (std::abs(sum - 1) > sum_tolerance) {
        f.error_at("parts", fmt::format("the weights sum to {:.9g}, they must sum to 1", sum));
        return nullptr;
    }
    return std::make_unique<MixtureMaterial>(parts);
}

MaterialPointer read_two_sided(SceneBuilder& b, Fields& f) {
    Material const* const front = read_part(b, f, "front");
    Material const* const back = read_part(b, f, "back");
    if (!front || !back) return nullptr;
    return std::make_unique<TwoSidedMaterial>(*front, *back);
}

}  // namespace iride
