// SPDX-License-Identifier: Apache-2.0
// Lights, sampled from a point they may illuminate. Densities are per steradian at that point.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "base/check.h"
#include "base/distribution.h"
#include "base/warp.h"
#include "materials/emission.h"
#include "materials/surface_point.h"
#include "scene/light_bounds.h"
#include "scene/light_emission.h"
#include "scene/shape.h"

namespace iride {

struct LightSample {
    Direction wi;                         // from the point to the light
    float distance;                       // metres; infinite for environments and distant lights
    Radiance radiance;                    // for a Dirac light: radiance times solid angle, i.e. irradiance / |cos|
    std::optional<PerSteradian> density;  // absent for a Dirac light (point, spot, distant)
    float cosine = 1;                     // against the normal of a lamp's surface
};

// A point that asks a light for a sample, and the answer.
struct LightRequest {
    Vector from;
    Sample2 u;
    Wavelengths const* wavelengths;
    std::optional<LightSample> sample = {};
    // Of the surface there: a light may then prefer what falls on it less obliquely, with a density that nothing but
    // the answer tells. 0: as density() has it.
    Vector normal{0, 0, 0};
};

class Light {
  public:
    virtual ~Light() = default;

    virtual std::optional<LightSample> sample(Vector const& from, Wavelengths const& wavelengths, Sample2 u) const = 0;
    // The same for several points; one after the other, unless a light knows better.
    virtual void answer(std::span<LightRequest> requests) const;

    // Radiance emitted at `on` (a point of this light's shape) along `wo`, away from the surface, and the density with
    // which sample(from) would have found that point, on triangle `primitive` of the shape.
    virtual Radiance emitted(SurfacePoint const& on, Direction const& wo, Wavelengths const& wavelengths) const;
    virtual PerSteradian density(Vector const& from, SurfacePoint const& on, std::uint32_t primitive) const;

    // Environments: radiance arriving from direction `wi`, and the density of sample() there.
    virtual Radiance arriving(Direction const& wi, Wavelengths const& wavelengths) const;
    virtual PerSteradian arriving_density(Direction const& wi) const;

    // A ray that leaves the light; and the density with which emit() draws one along `travel` where that makes
    // `cosine` with the front's normal (area lights; its sign tells the side).
    virtual std::optional<EmissionSample> emit(Ball const& scene, Wavelengths const& wavelengths, Sample2 place,
                                               Sample2 direction) const = 0;
    virtual EmissionDensity emission_density(Ball const& scene, Direction const& travel, float cosine) const = 0;
    virtual LightExtent extent() const = 0;

    // Luminous power up to a common factor, for choosing among lights; `scene_radius` in metres.
    virtual double power(double scene_radius) const = 0;
    virtual bool is_environment() const { return false; }
    // Whether it has the same radiance from everywhere.
    virtual bool is_uniform() const { return false; }

    // What a tree of lamps wants to know; absent for what comes from infinity.
    virtual std::optional<LightBounds> bounds() const { return std::nullopt; }
    // sample() with points of a shape uniform over its area, to compare.
    virtual std::optional<LightSample> sample_by_area(Vector const& from, Wavelengths const& wavelengths,
                                                      Sample2 u) const {
        return sample(from, wavelengths, u);
    }
};

// Luminance-weighted strengths are measured at load: the spectra themselves stay as they are.
struct EmitterStrength {
    Emitter emitter;
    double luminance;  // (integral of L ybar) / (integral of ybar)
};

// Area lights: sampled by the solid angle their shape subtends (spheres by the visible cone, rectangles and triangles
// exactly), discs and frusta by area.
std::unique_ptr<Light> make_area_light(Shape const& shape, EmitterStrength strength);

std::unique_ptr<Light> make_point_light(Vector const& position, Spectrum<dim::spectral_intensity> intensity,
                                        double luminance);
// Barn doors: planes through the lamp, parallel to one of two axes beside its beam. Light passes where the tangents of
// its direction, x and y over the part along the beam, are within limits.
struct SpotFlaps {
    Direction x, y;  // with the beam's axis an orthonormal frame
    Vector2 least, most;
};
struct SpotCone {
    Direction axis;
    float cos_full, cos_end;  // full inside cos_full, smooth cubic down to 0 at cos_end
    float exponent = 0;       // of a cosine power on top of it: nothing then goes backwards [Warn 1983]
    std::optional<SpotFlaps> flaps = {};
};
std::unique_ptr<Light> make_spot_light(Vector const& position, SpotCone cone,
                                       Spectrum<dim::spectral_intensity> intensity, double luminance);
std::unique_ptr<Light> make_distant_light(Direction const& travel, Spectrum<dim::spectral_irradiance> irradiance,
                                          double luminance);

std::unique_ptr<Light> make_constant_environment(Emission radiance, double luminance);

// Lat-long picture in linear Rec.709, one spectrum per primary: L(lambda) = sum_k texel_k basis_k(lambda).
struct EnvironmentPicture {
    int width, height;
    std::vector<std::array<float, 3>> texel;  // [height][width]; row 0 at +y, column centre looks to -z, x to the right
    std::array<Emission, 3> basis;
    float rotation_rad = 0;  // about y
};
std::unique_ptr<Light> make_picture_environment(EnvironmentPicture picture);

// All lights of a scene, chosen by power.
class LightSet {
  public:
    LightSet() = default;
    LightSet(std::vector<std::unique_ptr<Light>> lights, double scene_radius);

    bool empty() const { return lights_.empty(); }
    std::size_t size() const { return lights_.size(); }
    Light const& light(int index) const { return *lights_[static_cast<std::size_t>(index)]; }
    std::vector<int> const& environments() const { return environments_; }

    using Choice = DiscreteDistribution::Choice;
    // Whether any light has power: only then may one be chosen.
    bool has_power() const { return by_power_.size() > 0; }
    Choice choose(float u) const {
        check(has_power(), "a light that is chosen has power");
        if (by_power_.size() == 1) return {0, 1, u};
        return by_power_.sample(u);
    }
    float probability(int index) const { return has_power() ? by_power_.probability(index) : 0; }

  private:
    std::vector<std::unique_ptr<Light>> lights_;
    std::vector<int> environments_;
    DiscreteDistribution by_power_;
};

}  // namespace iride
