// SPDX-License-Identifier: Apache-2.0
// Plastic, varnish, glaze: a clear or absorbing dielectric coat, smooth or GGX rough, over a diffuse base.
#pragma once

#include <memory>

#include "materials/material.h"
#include "materials/surface_map.h"

namespace iride {

class PlasticMaterial : public Material {
  public:
    // n >= 1 and optical_depth >= 0 over the grid; roughness: GGX alpha, 0 for a smooth coat.
    PlasticMaterial(ReflectanceMap reflectance, SpectralFunction const& n, SpectralFunction const& optical_depth,
                    float roughness, WavelengthGrid const& grid);
    Bsdf at(SurfacePoint const& point, Wavelengths const& w) const override;

  private:
    ReflectanceMap reflectance_;
    Index n_;
    Reflectance depth_, internal_;  // a, R_i
    float roughness_, entering_;
    std::unique_ptr<CoatAlbedo const> albedo_;  // null: smooth
};

}  // namespace iride
