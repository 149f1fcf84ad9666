// SPDX-License-Identifier: Apache-2.0
// A material makes, at a surface point and for a packet of wavelengths, the closure that scatters there. The closure is
// a value (a variant): no heap, no virtual call behind it.
#pragma once

#include <memory>
#include <variant>

#include "materials/conductor.h"
#include "materials/dielectric.h"
#include "materials/lambert.h"
#include "spectral/spectrum.h"

namespace iride {

class Bsdf {
  public:
    using Model = std::variant<Black, Lambert, SmoothConductor, RoughConductor, SmoothDielectric>;

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
    Direction geometric_normal;  // the front side of the shape
    Frame frame;                 // shading frame; its normal is on the front side too
    Vector2 uv{0, 0};
};

class Material {
  public:
    virtual ~Material() = default;
    virtual Bsdf at(SurfacePoint const& point, Wavelengths const& wavelengths) const = 0;
    // Opaque models act alike on both sides: their frame is turned to wo. Dielectrics tell inside from outside.
    virtual bool is_two_sided() const { return true; }
    // Whether wavelengths part company here.
    virtual bool is_dispersive() const { return false; }
    // Whether some closure of this material has a density: if none has, light sampling is in vain.
    virtual bool has_density() const { return true; }
};

class DiffuseMaterial : public Material {
  public:
    explicit DiffuseMaterial(Reflectance reflectance) : reflectance_(std::move(reflectance)) {}
    Bsdf at(SurfacePoint const&, Wavelengths const& w) const override { return Lambert{reflectance_.at(w)}; }

  private:
    Reflectance reflectance_;
};

class BlackMaterial : public Material {
  public:
    Bsdf at(SurfacePoint const&, Wavelengths const&) const override { return Black{}; }
    bool has_density() const override { return false; }
};

class ConductorMaterial : public Material {
  public:
    // roughness: GGX alpha, 0 for a mirror.
    ConductorMaterial(Index n, Index k, float roughness) : n_(std::move(n)), k_(std::move(k)), roughness_(roughness) {}
    Bsdf at(SurfacePoint const&, Wavelengths const& w) const override {
        if (roughness_ == 0) return SmoothConductor{n_.at(w), k_.at(w)};
        return RoughConductor{n_.at(w), k_.at(w), {roughness_}};
    }
    bool has_density() const override { return roughness_ > 0; }

  private:
    Index n_, k_;
    float roughness_;
};

class DielectricMaterial : public Material {
  public:
    DielectricMaterial(Index inside, Index outside) : inside_(std::move(inside)), outside_(std::move(outside)) {}
    Bsdf at(SurfacePoint const&, Wavelengths const& w) const override {
        return SmoothDielectric{inside_.at(w), outside_.at(w)};
    }
    bool is_two_sided() const override { return false; }
    bool has_density() const override { return false; }
    bool is_dispersive() const override { return !inside_.is_constant() || !outside_.is_constant(); }

  private:
    Index inside_, outside_;
};

// A diffuse emitter: the same radiance in every direction of its front (or both) sides.
struct Emitter {
    Emission radiance;
    bool two_sided = false;
};

}  // namespace iride
