// SPDX-License-Identifier: Apache-2.0
// Transparent bodies.
#pragma once

#include "materials/material.h"
#include "materials/plane_stack.h"

namespace iride {

class DielectricMaterial : public Material {
  public:
    explicit DielectricMaterial(Body body)
        : Material({.two_sided = false,
                    .dispersive = !body.inside.n.is_constant() || !body.outside.n.is_constant(),
                    .has_density = false}),
          body_(std::move(body)),
          plane_{.outside = body_.outside.index, .inside = body_.inside.index} {}
    Bsdf at(SurfacePoint const& point, Wavelengths const& w) const override {
        return at_boundary(point, w, body_.outside.n.at(w));
    }
    Bsdf at_boundary(SurfacePoint const&, Wavelengths const& w, Lanes outside) const override {
        return SmoothDielectric{body_.inside.n.at(w), outside};
    }
    Body const* body() const override { return &body_; }

    PlaneStack const* plane() const override { return &plane_; }

  private:
    Body body_;
    PlaneStack plane_;
};

}  // namespace iride
