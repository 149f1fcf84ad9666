// SPDX-License-Identifier: Apache-2.0
// Transparent bodies under thin films, and thin films by themselves: antireflection coatings, soap bubbles.
#pragma once

#include "materials/material.h"

namespace iride {

// The boundary of a body; what surrounds it is the coating table's outside.
class CoatedDielectricMaterial : public Material {
  public:
    CoatedDielectricMaterial(CoatingTable table, WavelengthGrid const& grid)
        : Material({.two_sided = false,
                    .dispersive = !table.stack().inside.n.is_constant() || !table.stack().outside.n.is_constant(),
                    .has_density = false,
                    .transmits = true,
                    .filmed = true}),
          table_(std::move(table)),
          body_{medium(table_.stack().inside, grid), medium(table_.stack().outside, grid), std::nullopt, true} {}
    Bsdf at(SurfacePoint const&, Wavelengths const& w) const override {
        return SmoothCoatedDielectric{&table_, table_.row_of(w), body_.inside.n.at(w), body_.outside.n.at(w)};
    }
    Body const* body() const override { return &body_; }
    PlaneStack const* plane() const override { return &table_.stack(); }

  private:
    static Medium medium(ComplexIndex const& index, WavelengthGrid const& grid) {
        return {.n = Index(index.n, grid), .index = index};
    }

    CoatingTable table_;
    Body body_;
};

// Layers between two equal media, whatever these are: the first one is on the front side. No boundary of a body.
class FilmMaterial : public Material {
  public:
    explicit FilmMaterial(CoatingTable table)
        : Material({.two_sided = false, .has_density = false, .transmits = true, .filmed = true}),
          table_(std::move(table)) {}
    Bsdf at(SurfacePoint const&, Wavelengths const& w) const override {
        return SmoothCoatedDielectric{&table_, table_.row_of(w), Lanes(1), Lanes(1)};
    }
    PlaneStack const* plane() const override { return &table_.stack(); }

  private:
    CoatingTable table_;
};

}  // namespace iride
