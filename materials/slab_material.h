// SPDX-License-Identifier: Apache-2.0
// Panes that are one surface.
#pragma once

#include "materials/material.h"

namespace iride {

class SlabMaterial : public Material {
  public:
    // thickness [m].
    SlabMaterial(Medium medium, float thickness)
        : Material({.has_density = false, .transmits = true}), medium_(std::move(medium)), thickness_(thickness) {}
    Bsdf at(SurfacePoint const&, Wavelengths const& w) const override {
        return ThinSlab{medium_.n.at(w), Lanes(medium_.sigma_a.at(w).lane * thickness_)};
    }

  private:
    Medium medium_;
    float thickness_;
};

}  // namespace iride
