// SPDX-License-Identifier: Apache-2.0
// The heuristic models, with parameters as their authors have them or as albedos.
#pragma once

#include "materials/material.h"
#include "materials/surface_map.h"

namespace iride {

enum class HeuristicForm {
    raw,         // k_d and k_s themselves [1/sr]
    normalised,  // the shares of light along the normal that either term gives back
};

class HeuristicMaterial : public Material {
  public:
    HeuristicMaterial(HeuristicLobe lobe, HeuristicForm form, ReflectanceMap diffuse, ReflectanceMap specular,
                      float exponent)
        : Material({}), lobe_(lobe), diffuse_(std::move(diffuse)), specular_(std::move(specular)), exponent_(exponent) {
        if (form == HeuristicForm::raw) return;
        per_diffuse_ = inverse_pi;
        per_specular_ = static_cast<float>(1 / lobe_albedo(lobe, static_cast<double>(exponent)));
    }
    Bsdf at(SurfacePoint const& point, Wavelengths const& w) const override {
        Lanes const k_d = diffuse_.at(point, w) * per_diffuse_, k_s = specular_.at(point, w) * per_specular_;
        switch (lobe_) {
            case HeuristicLobe::phong:
                return Phong{k_d, k_s, exponent_};
            case HeuristicLobe::blinn_phong:
                return BlinnPhong{k_d, k_s, exponent_};
            case HeuristicLobe::modified_blinn_phong:
                break;
        }
        return ModifiedBlinnPhong{k_d, k_s, exponent_};
    }

  private:
    HeuristicLobe lobe_;
    ReflectanceMap diffuse_, specular_;
    float exponent_, per_diffuse_ = 1, per_specular_ = 1;
};

}  // namespace iride
