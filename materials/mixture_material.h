// SPDX-License-Identifier: Apache-2.0
// Materials made of others: a convex mixture, f = sum_k weight_k f_k, and one with a front and a back.
// A mixture's closure at a hit is that of one part, drawn with probability weight_k by the meeting's random number, so
// that no closure grows; what is left of the number is fresh for a part that is a mixture itself. The parts belong to
// the scene and outlive these.
#pragma once

#include "base/distribution.h"
#include "materials/material.h"

namespace iride {

class MixtureMaterial : public Material {
  public:
    struct Part {
        Material const* material;
        double weight;  // >= 0, of which some is above 0; they sum to 1
    };
    // The parts act alike on both sides (traits.two_sided).
    explicit MixtureMaterial(std::vector<Part> const& parts);
    Bsdf at(SurfacePoint const& point, Wavelengths const& w) const override;

  private:
    std::vector<Material const*> parts_;
    DiscreteDistribution choice_;
};

class TwoSidedMaterial : public Material {
  public:
    // Both act alike on both sides (traits.two_sided).
    TwoSidedMaterial(Material const& front, Material const& back);
    Bsdf at(SurfacePoint const& point, Wavelengths const& w) const override {
        return (point.from_front ? front_ : back_).at(point, w);
    }

  private:
    Material const &front_, &back_;
};

}  // namespace iride
