// SPDX-License-Identifier: Apache-2.0
// Opaque materials without a surface of their own.
#pragma once

#include "materials/material.h"
#include "materials/surface_map.h"

namespace iride {

class DiffuseMaterial : public Material {
  public:
    explicit DiffuseMaterial(ReflectanceMap reflectance)
        : Material({.textured = reflectance.varies(), .diffuse = true, .lambertian = true}),
          reflectance_(std::move(reflectance)) {}
    Bsdf at(SurfacePoint const& point, Wavelengths const& w) const override {
        return Lambert{reflectance_.at(point, w)};
    }

  private:
    ReflectanceMap reflectance_;
};

class BlackMaterial : public Material {
  public:
    BlackMaterial() : Material({.has_density = false}) {}
    Bsdf at(SurfacePoint const&, Wavelengths const&) const override { return Black{}; }
};

}  // namespace iride
