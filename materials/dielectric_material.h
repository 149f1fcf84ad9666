// SPDX-License-Identifier: Apache-2.0
// Transparent bodies, smooth or rough.
#pragma once

#include "materials/material.h"
#include "materials/plane_stack.h"

namespace iride {

class DielectricMaterial final : public Material {
  public:
    // n of either side is above 0 over the sampled range, if the surface is rough.
    DielectricMaterial(Body body, RoughSurface surface, WavelengthRange const& sampled);
    void prepare_for(std::span<Medium const* const> outside) override;

    Bsdf at(SurfacePoint const& point, Wavelengths const& w) const override {
        return at_boundary(point, w, body_.outside.n.at(w));
    }
    Bsdf at_boundary(SurfacePoint const&, Wavelengths const& w, Lanes outside) const override {
        Lanes const inside = body_.inside.n.at(w);
        if (facets_.is_smooth()) return SmoothDielectric{inside, outside};
        BoundaryLoss const* const loss = &loss_of(inside[0] / outside[0]);
        if (facets_.is_plain()) return RoughDielectric<Ggx>{inside, outside, facets_.plain(), loss};
        return RoughDielectric<FacetsOfMaterial>{inside, outside, {&facets_}, loss};
    }
    Body const* body() const override { return &body_; }

    PlaneStack const* plane() const override { return &plane_; }

  private:
    BoundaryLoss const& loss_of(float eta) const;

    Body body_;
    PlaneStack plane_;
    Facets facets_;
    WavelengthRange sampled_;
    std::vector<BoundaryLoss> losses_;  // of rough surfaces: ranges of eta that do not overlap, ascending
};

}  // namespace iride
