// SPDX-License-Identifier: Apache-2.0
// A material makes, at a surface point and for a packet of wavelengths, the closure that scatters there.
#pragma once

#include <span>

#include "materials/closure.h"
#include "materials/medium.h"
#include "materials/surface_point.h"
#include "spectral/spectrum.h"

namespace iride {

struct PlaneStack;

// What is known of a material before it is hit.
struct MaterialTraits {
    bool two_sided = true;  // acts alike on both sides: the frame is turned to wo; dielectrics tell inside from outside
    bool dispersive = false;   // wavelengths part company here
    bool has_density = true;   // some closure has a density: if none has, light sampling is in vain
    bool transmits = false;    // some light goes through
    bool filmed = false;       // thin films interfere
    bool textured = false;     // looks at uv
    bool diffuse = false;      // scatters all over the side that light comes from, with no peak
    bool lambertian = false;   // sends what it scatters in all directions alike: its closures are Lambert's
    bool anisotropic = false;  // looks at the tangent
    Vector2 grain{1, 0};       // x axis of anisotropic facets along tangent and bitangent of the surface
};

class Material {
  public:
    virtual ~Material() = default;
    virtual Bsdf at(SurfacePoint const& point, Wavelengths const& wavelengths) const = 0;

    // The transparent body that this surface bounds; null for all others.
    virtual Body const* body() const { return nullptr; }
    // The closure where a medium of index `outside` lies in front of that body.
    virtual Bsdf at_boundary(SurfacePoint const& point, Wavelengths const& wavelengths, Lanes /*outside*/) const {
        return at(point, wavelengths);
    }
    // Told once, before any closure is made: the media that may lie in front of that body if it has a priority.
    virtual void prepare_for(std::span<Medium const* const> /*outside*/) {}
    // The plane surface that the material is, or that its facets are, for colorimetry; null if it is no such thing.
    virtual PlaneStack const* plane() const { return nullptr; }

    MaterialTraits const traits;

  protected:
    explicit Material(MaterialTraits const& t) : traits(t) {}
};

}  // namespace iride
