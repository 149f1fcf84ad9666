// SPDX-License-Identifier: Apache-2.0
// Metals: smooth or rough, bare or coated.
#pragma once

#include <memory>

#include "materials/material.h"
#include "spectral/complex_index.h"

namespace iride {

class ConductorMaterial : public Material {
  public:
    // roughness: GGX alpha, 0 for a mirror, which has nothing to scatter several times.
    ConductorMaterial(ComplexIndex const& index, float roughness, bool multiple_scattering, WavelengthGrid const& grid);
    Bsdf at(SurfacePoint const&, Wavelengths const& w) const override {
        if (roughness_ == 0) return SmoothConductor{n_.at(w), k_.at(w)};
        if (!albedo_) return RoughConductor{n_.at(w), k_.at(w), {roughness_}};
        return InterreflectingConductor{n_.at(w), k_.at(w), multiple_fresnel_.at(w), {roughness_}, albedo_.get()};
    }

  private:
    Index n_, k_;
    float roughness_;
    std::unique_ptr<GgxAlbedo const> albedo_;  // null: single scattering
    Reflectance multiple_fresnel_;
};

class CoatedConductorMaterial : public Material {
  public:
    // roughness: GGX alpha, 0 for a mirror; the coating follows the facets.
    CoatedConductorMaterial(CoatingTable table, float roughness)
        : Material({.has_density = roughness > 0}), table_(std::move(table)), roughness_(roughness) {}
    Bsdf at(SurfacePoint const&, Wavelengths const& w) const override {
        CoatedFresnel const fresnel{&table_, table_.row_of(w)};
        if (roughness_ == 0) return SmoothCoatedConductor{fresnel};
        return RoughCoatedConductor{fresnel, {roughness_}};
    }

  private:
    CoatingTable table_;
    float roughness_;
};

}  // namespace iride
