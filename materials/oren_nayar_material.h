// SPDX-License-Identifier: Apache-2.0
// Rough diffuse materials.
#pragma once

#include "materials/material.h"
#include "materials/surface_map.h"

namespace iride {

class OrenNayarMaterial : public Material {
  public:
    // roughness: 0 (Lambert) .. 1.
    OrenNayarMaterial(ReflectanceMap reflectance, float roughness)
        : Material({.textured = reflectance.varies(), .diffuse = true}),
          reflectance_(std::move(reflectance)),
          roughness_(roughness) {}
    Bsdf at(SurfacePoint const& point, Wavelengths const& w) const override {
        return OrenNayar{reflectance_.at(point, w), roughness_};
    }

  private:
    ReflectanceMap reflectance_;
    float roughness_;
};

}  // namespace iride
