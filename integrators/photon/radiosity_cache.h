// SPDX-License-Identifier: Apache-2.0
// A radiosity solution as what a final gather looks up; caustics are those of photons, which a solution of diffuse
// patches does not have.
#pragma once

#include "integrators/photon/radiance_cache.h"
#include "integrators/radiosity/radiosity.h"

namespace iride {

class RadiosityCache final : public RadianceCache {
  public:
    // `photons` must live as long.
    RadiosityCache(Scene const& scene, RenderPlan const& plan, RadianceCache const& photons)
        : photons_(photons), solution_(scene, plan.wavelengths, {}) {}

    // Of the patch that the path's last ray meets: near the point, where surfaces curve.
    Radiance all(CachedPoint const& point) const override {
        auto const met = solution_.tracer().closest(point.arriving);
        if (!met || met->patch < 0) return {};
        Radiance const emitted = emitted_at(point.scene, point.at.hit, point.arriving, point.wavelengths);
        Radiance const reflected = max(Radiance(), solution_.radiance(*met, point.wavelengths) - emitted);
        return point.at.state.weight * reflected * (1 / mean(point.at.state.reach));
    }
    bool has_narrow() const override { return true; }
    Radiance direct_and_caustic(CachedPoint const& point) const override { return photons_.direct_and_caustic(point); }

  private:
    RadianceCache const& photons_;
    radiosity::SceneRadiosity solution_;
};

}  // namespace iride
