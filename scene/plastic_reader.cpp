// SPDX-License-Identifier: Apache-2.0
// Coated diffuse materials, as a scene file gives them.
#include "materials/plastic_material.h"
#include "scene/material_readers.h"
#include "scene/texture_readers.h"

namespace iride {

namespace {

// What a coat lets through along its normal, once; below the least value it hides its base to the last bit of a float.
constexpr double least_transmittance = 1e-8;
constexpr SpectrumKind coat_kind{SpectralQuantity::reflectance, Outside::hold, false, least_transmittance, 1};

// -ln of a transmittance, at whole nanometres.
SpectralFunction optical_depth(SpectralFunction const& transmittance, WavelengthGrid const& grid) {
    if (transmittance.is_constant()) return SpectralFunction::constant(std::max(0.0, -std::log(transmittance.at(0))));
    TabulatedShape table;
    for (int i = 0; i < grid.count; ++i) {
        table.nm.push_back(grid.first_nm + i);
        table.value.push_back(std::max(0.0, -std::log(transmittance.at(table.nm.back()))));
    }
    return SpectralFunction(std::move(table), Outside::hold);
}

}  // namespace

MaterialPointer read_plastic(SceneBuilder& b, Fields& f) {
    auto const reflectance = read_reflectance_map(b, f, "reflectance");
    auto const ior =
        f.find("ior") ? read_complex_index(b, f, "ior")
                      : std::optional<ComplexIndex>({SpectralFunction::constant(1.5), SpectralFunction::constant(0)});
    auto const transmittance = f.find("coat_transmittance") ? read_spectrum(b, f, "coat_transmittance", coat_kind)
                                                            : SpectralFunction::constant(1);
    double const roughness = f.number("roughness", between(0, 1)).value_or(0);
    if (roughness > 0 && roughness < smallest_roughness)
        f.error_at("roughness", "allowed: 0 (a smooth coat) or 0.001 .. 1 (GGX alpha)");
    if (!reflectance || !ior || !transmittance) return nullptr;
    if (ior->k.largest(b.scene.wavelengths) > 0) {
        f.error_at("ior", "the coat absorbs (k > 0): say so by 'coat_transmittance'");
        return nullptr;
    }
    if (ior->n.smallest(b.scene.wavelengths) < 1) {
        f.error_at("ior", "allowed: an index of at least 1, that of the air around");
        return nullptr;
    }
    return std::make_unique<PlasticMaterial>(*reflectance, ior->n, optical_depth(*transmittance, b.scene.grid),
                                             static_cast<float>(roughness), b.scene.grid);
}

}  // namespace iride
