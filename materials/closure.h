// SPDX-License-Identifier: Apache-2.0
// The closure that scatters at one surface point: a value (a variant of the models), no heap, no virtual call behind
// it.
#pragma once

#include <variant>

#include "materials/coated_dielectric.h"
#include "materials/conductor.h"
#include "materials/dielectric.h"
#include "materials/heuristic.h"
#include "materials/lambert.h"
#include "materials/oren_nayar.h"
#include "materials/plastic.h"
#include "materials/rough_dielectric.h"
#include "materials/thin_slab.h"

namespace iride {

class Bsdf {
  public:
    using Model =
        std::variant<Black, Lambert, SmoothConductor, RoughConductor, RoughMetal<BareFresnel, FacetsOfMaterial>,
                     SmoothCoatedConductor, RoughCoatedConductor, RoughMetal<CoatedFresnel, FacetsOfMaterial>,
                     SmoothDielectric, RoughDielectric<Ggx>, RoughDielectric<FacetsOfMaterial>, SmoothCoatedDielectric,
                     ThinSlab, OrenNayar, SmoothPlastic, RoughPlastic, Phong, BlinnPhong, ModifiedBlinnPhong>;

    template <BsdfModel T>
    Bsdf(T const& model) : model_(model) {}

    BsdfEvaluation evaluate(Direction const& wo, Direction const& wi) const {
        return std::visit([&](auto const& m) { return m.evaluate(wo, wi); }, model_);
    }
    std::optional<BsdfSample> sample(Direction const& wo, Sample3 u) const {
        return std::visit([&](auto const& m) { return m.sample(wo, u); }, model_);
    }
    // Whether evaluate() can be other than zero.
    bool has_density() const {
        return std::visit([](auto const& m) { return std::decay_t<decltype(m)>::has_density; }, model_);
    }

  private:
    Model model_;
};

}  // namespace iride
