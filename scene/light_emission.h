// SPDX-License-Identifier: Apache-2.0
// Rays that leave a light, and the density with which they are drawn. With p_A over the light's area and p_w over
// directions, flux = Le |cos| / (p_A p_w), whose mean is the light's power. A light at infinity sends its rays through
// a disc as wide as the scene, across the direction of travel; the cosine is 1 there. What a light has no extent in
// (the place of a point, the direction of a distant light) has density 1, in units of the Dirac. [Veach 1997, sec. 8.3]
#pragma once

#include "base/distribution.h"
#include "base/quantity.h"
#include "base/warp.h"
#include "materials/surface_point.h"
#include "spectral/sampled.h"

namespace iride {

// Encloses the scene.
struct Ball {
    Vector centre;
    float radius;
};

struct EmissionDensity {
    PerSquareMetre area{1};
    PerSteradian direction{1};
    float product() const { return area.value * direction.value; }
};

// Where a light is in extent, in direction or at all: what other ways there are to find its rays.
enum class LightExtent {
    area,         // a surface: found by scattering, and by sampling from a point
    point,        // one place, many directions
    distant,      // one direction
    environment,  // many directions, from infinity
};

using Flux = Sampled<Dimension{.watt = 1, .nanometre = -1}>;

struct EmissionSample {
    SurfacePoint from;        // on a surface: the place, with its normal; else where the ray starts
    std::uint32_t primitive;  // triangle of a mesh
    Direction travel;
    float cosine;  // against the emitting surface's normal, > 0; 1 without one
    EmissionDensity density;
    Radiance radiance;  // of a point: intensity; of a distant light: irradiance, both in units of the Dirac

    Flux flux() const { return Flux(radiance.lane * (cosine / density.product())); }
};

// The place on the disc before the scene from which rays along `travel` set out; density 1 / (pi radius^2).
inline Vector place_before_scene(Ball const& scene, Direction const& travel, Sample2 u) {
    Vector2 const d = scene.radius * to_disc(u);
    Frame const across = Frame::around(travel);
    return scene.centre - scene.radius * travel + across.tangent * d.x() + across.bitangent * d.y();
}
inline PerSquareMetre density_before_scene(Ball const& scene) {
    return PerSquareMetre(inverse_pi / square(scene.radius));
}

}  // namespace iride
