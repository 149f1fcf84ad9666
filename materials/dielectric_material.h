// SPDX-License-Identifier: Apache-2.0
// Transparent bodies, smooth or rough.
#pragma once

#include "materials/material.h"
#include "materials/plane_stack.h"

namespace iride {

class DielectricMaterial final : public Material {
  public:
    // eta_range: n(inside) / n(outside) over the sampled wavelengths; rough surfaces are prepared for it.
    DielectricMaterial(Body body, RoughSurface surface, std::pair<double, double> eta_range)
        : Material({.two_sided = false,
                    .dispersive = !body.inside.n.is_constant() || !body.outside.n.is_constant(),
                    .has_density = !surface.facets.is_smooth(),
                    .anisotropic = surface.facets.is_anisotropic(),
                    .grain = surface.grain()}),
          body_(std::move(body)),
          plane_{.outside = body_.outside.index, .inside = body_.inside.index},
          facets_(std::move(surface.facets)) {
        if (!facets_.is_smooth()) loss_.emplace(facets_, eta_range.first, eta_range.second);
    }
    Bsdf at(SurfacePoint const& point, Wavelengths const& w) const override {
        return at_boundary(point, w, body_.outside.n.at(w));
    }
    Bsdf at_boundary(SurfacePoint const&, Wavelengths const& w, Lanes outside) const override {
        Lanes const inside = body_.inside.n.at(w);
        if (!loss_) return SmoothDielectric{inside, outside};
        if (facets_.is_plain()) return RoughDielectric<Ggx>{inside, outside, facets_.plain(), &*loss_};
        return RoughDielectric<FacetsOfMaterial>{inside, outside, {&facets_}, &*loss_};
    }
    Body const* body() const override { return &body_; }

    PlaneStack const* plane() const override { return &plane_; }

  private:
    Body body_;
    PlaneStack plane_;
    Facets facets_;
    std::optional<BoundaryLoss> loss_;  // of rough surfaces
};

}  // namespace iride
