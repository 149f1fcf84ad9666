// SPDX-License-Identifier: Apache-2.0
// A material makes, at a surface point and for a packet of wavelengths, the closure that scatters there. The closure is
// a value (a variant): no heap, no virtual call behind it.
#pragma once

#include <memory>
#include <variant>

#include "materials/conductor.h"
#include "materials/dielectric.h"
#include "materials/lambert.h"
#include "spectral/complex_index.h"
#include "spectral/spectrum.h"

namespace iride {

class Bsdf {
  public:
    using Model = std::variant<Black, Lambert, SmoothConductor, RoughConductor, InterreflectingConductor,
                               SmoothDielectric, SmoothCoatedConductor, RoughCoatedConductor>;

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

// What a material may look at.
struct SurfacePoint {
    Vector position;
    Direction geometric_normal;  // on the front side of the shape
    Direction normal;            // for shading; on the front side too
    Vector2 uv{0, 0};
};

// What is known of a material before it is hit.
struct MaterialTraits {
    bool two_sided = true;  // acts alike on both sides: the frame is turned to wo; dielectrics tell inside from outside
    bool dispersive = false;  // wavelengths part company here
    bool has_density = true;  // some closure has a density: if none has, light sampling is in vain
};

class Material {
  public:
    virtual ~Material() = default;
    virtual Bsdf at(SurfacePoint const& point, Wavelengths const& wavelengths) const = 0;

    MaterialTraits const traits;

  protected:
    explicit Material(MaterialTraits const& t) : traits(t) {}
};

class DiffuseMaterial : public Material {
  public:
    explicit DiffuseMaterial(Reflectance reflectance) : Material({}), reflectance_(std::move(reflectance)) {}
    Bsdf at(SurfacePoint const&, Wavelengths const& w) const override { return Lambert{reflectance_.at(w)}; }

  private:
    Reflectance reflectance_;
};

class BlackMaterial : public Material {
  public:
    BlackMaterial() : Material({.has_density = false}) {}
    Bsdf at(SurfacePoint const&, Wavelengths const&) const override { return Black{}; }
};

class ConductorMaterial : public Material {
  public:
    // roughness: GGX alpha, 0 for a mirror, which has nothing to scatter several times.
    ConductorMaterial(ComplexIndex const& index, float roughness, bool multiple_scattering, WavelengthGrid const& grid);
    Bsdf at(SurfacePoint const&, Wavelengths const& w) const override {
        if (roughness_ == 0) return SmoothConductor{n_.at(w), k_.at(w)};
        if (!albedo_) return RoughConductor{n_.at(w), k_.at(w), {roughness_}};
        return InterreflectingConductor{n_.at(w), k_.at(w), multiple_fresnel_.at(w), {roughness_}, albedo_.get()};
    }

  private:
    Index n_, k_;
    float roughness_;
    std::unique_ptr<GgxAlbedo const> albedo_;  // null: single scattering
    Reflectance multiple_fresnel_;
};

class CoatedConductorMaterial : public Material {
  public:
    // roughness: GGX alpha, 0 for a mirror; the coating follows the facets.
    CoatedConductorMaterial(CoatingTable table, float roughness)
        : Material({.has_density = roughness > 0}), table_(std::move(table)), roughness_(roughness) {}
    Bsdf at(SurfacePoint const&, Wavelengths const& w) const override {
        CoatedFresnel const fresnel{&table_, table_.row_of(w)};
        if (roughness_ == 0) return SmoothCoatedConductor{fresnel};
        return RoughCoatedConductor{fresnel, {roughness_}};
    }

  private:
    CoatingTable table_;
    float roughness_;
};

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

// A diffuse emitter: the same radiance in every direction of its front (or both) sides.
struct Emitter {
    Emission radiance;
    bool two_sided = false;
};

}  // namespace iride
