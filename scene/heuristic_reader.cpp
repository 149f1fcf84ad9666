// SPDX-License-Identifier: Apache-2.0
// The heuristic models, as a scene file gives them. What gives back more light than it gets is said in the load report.
#include <fmt/format.h>

#include "materials/heuristic_material.h"
#include "scene/material_readers.h"

namespace iride {

namespace {

constexpr SpectrumKind coefficient_kind{SpectralQuantity::reflectance, Outside::hold, false, 0, 1e3};  // 1/sr

// Largest share of light along the normal that is given back, over the render range.
double largest_albedo(SpectralFunction const& diffuse, SpectralFunction const& specular, double per_diffuse,
                      double per_specular, WavelengthGrid const& grid) {
    double largest = 0;
    for (int i = 0; i < grid.count; ++i) {
        double const nm = grid.first_nm + i;
        largest = std::max(largest, per_diffuse * diffuse.at(nm) + per_specular * specular.at(nm));
    }
    return largest;
}

MaterialPointer read_heuristic(SceneBuilder& b, Fields& f, HeuristicLobe lobe) {
    bool const raw = f.choice("form", {"raw", "normalised"}) == "raw";
    SpectrumKind const& kind = raw ? coefficient_kind : reflectance_kind;
    auto const diffuse =
        f.find("diffuse") ? read_spectrum(b, f, "diffuse", kind) : std::optional(SpectralFunction::constant(0));
    auto const specular = read_spectrum(b, f, "specular", kind);
    double const exponent = f.required_number("exponent", between(0, 1e5));
    if (!diffuse || !specular) return nullptr;

    double const per_diffuse = raw ? pi_double : 1, per_specular = raw ? lobe_albedo(lobe, exponent) : 1;
    double const albedo = largest_albedo(*diffuse, *specular, per_diffuse, per_specular, b.scene.grid);
    constexpr double rounding = 1e-9;
    if (albedo > 1 + rounding && !raw) {
        f.error(fmt::format("'diffuse' and 'specular' sum to {:g}, allowed: at most 1", albedo));
        return nullptr;
    }
    if (albedo > 1 + rounding)
        b.context.remark(f.key_path(), fmt::format("this model gives back {:.4g} times the light along the normal that "
                                                   "it gets",
                                                   albedo));
    if (lobe != HeuristicLobe::modified_blinn_phong && specular->largest(b.scene.wavelengths) > 0)
        b.context.remark(f.key_path(),
                         "this model is not reciprocal, and near grazing incidence it gives back more light "
                         "than it gets");
    return std::make_unique<HeuristicMaterial>(lobe, raw ? HeuristicForm::raw : HeuristicForm::normalised,
                                               Reflectance(*diffuse, b.scene.grid),
                                               Reflectance(*specular, b.scene.grid), static_cast<float>(exponent));
}

}  // namespace

MaterialPointer read_phong(SceneBuilder& b, Fields& f) { return read_heuristic(b, f, HeuristicLobe::phong); }
MaterialPointer read_blinn_phong(SceneBuilder& b, Fields& f) {
    return read_heuristic(b, f, HeuristicLobe::blinn_phong);
}
MaterialPointer read_modified_blinn_phong(SceneBuilder& b, Fields& f) {
    return read_heuristic(b, f, HeuristicLobe::modified_blinn_phong);
}

}  // namespace iride
