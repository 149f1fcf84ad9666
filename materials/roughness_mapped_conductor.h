// SPDX-License-Identifier: Apache-2.0
// A bare metal whose roughness varies over its surface. With multiple scattering, the light that the facets return is
// tabulated for one roughness each, so a roughness is rounded to the nearest of at most 64 in equal ratios: by 1.5 % at
// most where the map spans a factor of 6, by 6 % for .001 .. 1. The energy of each is exact.
#pragma once

#include <memory>
#include <vector>

#include "materials/facet_loss.h"
#include "materials/material.h"
#include "materials/surface_map.h"
#include "spectral/complex_index.h"

namespace iride {

class RoughnessMappedConductor final : public Material {
  public:
    // roughness: GGX alpha, everywhere > 0.
    RoughnessMappedConductor(ComplexIndex const& index, ScalarMap roughness, bool multiple_scattering,
                             WavelengthGrid const& grid);
    Bsdf at(SurfacePoint const& point, Wavelengths const& w) const override;

  private:
    struct Level {
        float roughness;
        std::shared_ptr<FacetLoss const> loss;
    };
    Level const& nearest(float roughness) const;

    Index n_, k_;
    ScalarMap roughness_;
    Reflectance mean_fresnel_;         // 2 int F(mu) mu dmu
    std::vector<Level> levels_;        // empty: single scattering
    float first_ = 0, per_level_ = 0;  // logarithms of roughness
};

}  // namespace iride
