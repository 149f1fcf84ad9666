// SPDX-License-Identifier: Apache-2.0
// The seam between a camera path and what is known of the light beforehand: radiance that leaves a surface point along
// the path, without what the surface emits and without Dirac lobes, which the path itself follows.
#pragma once

#include "base/sampler.h"
#include "integrators/photon/photon_map.h"

namespace iride {

// A random number each for which light and for where on it.
struct LightNumbers {
    float choice;
    Sample2 place;
};

// A gather point with the rest of its path.
struct CachedPoint {
    Scene const& scene;
    GatherPoint at;
    Ray const& arriving;  // from the camera's side
    Surroundings const& in;
    Wavelengths const& wavelengths;
    LightNumbers light;
    RayStatistics& statistics;
};

class RadianceCache {
  public:
    virtual ~RadianceCache() = default;
    // Weight and reach of the path included.
    virtual Radiance all(CachedPoint const& point) const = 0;
    // Whether all() has narrow directions too, which otherwise the path follows.
    virtual bool has_narrow() const = 0;
    // The same without light that comes from another scattering than by Dirac lobes: what a path adds that scatters
    // here and gathers where it arrives next. Without narrow directions.
    virtual Radiance direct_and_caustic(CachedPoint const& point) const = 0;
};

}  // namespace iride
