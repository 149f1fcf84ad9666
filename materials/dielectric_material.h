// SPDX-License-Identifier: Apache-2.0
// Transparent bodies.
#pragma once

#include "materials/material.h"

namespace iride {

class DielectricMaterial : public Material {
  public:
    DielectricMaterial(Index inside, Index outside)
        : Material({.two_sided = false,
                    .dispersive = !inside.is_constant() || !outside.is_constant(),
                    .has_density = false}),
          inside_(std::move(inside)),
          outside_(std::move(outside)) {}
    Bsdf at(SurfacePoint const&, Wavelengths const& w) const override {
        return SmoothDielectric{inside_.at(w), outside_.at(w)};
    }

  private:
    Index inside_, outside_;
};

}  // namespace iride
