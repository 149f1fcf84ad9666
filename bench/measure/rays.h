// SPDX-License-Identifier: Apache-2.0
// How near a render comes to bare ray tracing: its rays per second against those of a loop that traces the very same
// rays, in their order, in one thread, and does nothing else.
#pragma once

#include "integrators/render.h"

namespace iride::bench {

struct RayRates {
    double rendered, bare;    // rays per second
    double paths_per_second;  // of the render
    double ratio() const { return rendered / bare; }
};

class RayRace {
  public:
    RayRace(Scene const& scene, std::string const& integrator, int spp);
    // Render, then trace bare.
    RayRates round() const;
    std::size_t ray_count() const { return rays_.size(); }

  private:
    Scene const& scene_;
    RenderPlan plan_;
    std::unique_ptr<Integrator> integrator_;
    int spp_;
    std::vector<RecordedRay> rays_;
};

}  // namespace iride::bench
