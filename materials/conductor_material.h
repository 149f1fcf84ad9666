// SPDX-License-Identifier: Apache-2.0
// Metals: smooth or rough, bare or coated.
#pragma once

#include <memory>

#include "materials/material.h"
#include "materials/plane_stack.h"

namespace iride {

// What light of several bounces between a metal's facets needs, worked out before it is hit.
class Interreflection {
  public:
    // mean_fresnel: F_avg at a wavelength in nm. Smooth facets, or none: single scattering.
    Interreflection() = default;
    Interreflection(Facets const& facets, WavelengthGrid const& grid,
                    std::function<double(double)> const& mean_fresnel);

    // The closure of rough facets with this Fresnel term.
    template <class Fresnel>
    Bsdf closure(Fresnel const& fresnel, Facets const& facets, Wavelengths const& w) const {
        Lanes const multiple = loss_ ? multiple_fresnel_.at(w) : Lanes();
        if (facets.is_plain()) return RoughMetal<Fresnel, Ggx>{fresnel, facets.plain(), loss_.get(), multiple};
        return RoughMetal<Fresnel, FacetsOfMaterial>{fresnel, {&facets}, loss_.get(), multiple};
    }

  private:
    std::shared_ptr<FacetLoss const> loss_;  // null: single scattering
    Reflectance multiple_fresnel_;
};

class ConductorMaterial : public Material {
  public:
    ConductorMaterial(ComplexIndex const& index, RoughSurface surface, bool multiple_scattering,
                      WavelengthGrid const& grid);
    Bsdf at(SurfacePoint const&, Wavelengths const& w) const override {
        if (facets_.is_smooth()) return SmoothConductor{n_.at(w), k_.at(w)};
        return interreflection_.closure(BareFresnel{n_.at(w), k_.at(w)}, facets_, w);
    }
    PlaneStack const* plane() const override { return &plane_; }

  private:
    PlaneStack plane_;
    Index n_, k_;
    Facets facets_;
    Interreflection interreflection_;
};

// The coating follows the facets.
class CoatedConductorMaterial : public Material {
  public:
    CoatedConductorMaterial(CoatingTable table, RoughSurface surface, bool multiple_scattering,
                            WavelengthGrid const& grid);
    Bsdf at(SurfacePoint const&, Wavelengths const& w) const override {
        CoatedFresnel const fresnel{&table_, table_.row_of(w)};
        if (facets_.is_smooth()) return SmoothCoatedConductor{fresnel};
        return interreflection_.closure(fresnel, facets_, w);
    }
    PlaneStack const* plane() const override { return &table_.stack(); }

  private:
    CoatingTable table_;
    Facets facets_;
    Interreflection interreflection_;
};

}  // namespace iride
