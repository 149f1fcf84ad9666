// SPDX-License-Identifier: Apache-2.0
// What light is in where it sets out: found once for a lamp on which some rays agree, else for each ray. What comes
// from infinity has crossed all that fills the place between bodies.
#pragma once

#include <vector>

#include "integrators/plan.h"
#include "scene/bodies.h"

namespace iride {

// The ray that a light sends.
inline Ray leaving_ray(Light const& light, EmissionSample const& e) {
    return light.extent() == LightExtent::area ? spawn_ray(e.from, e.travel) : Ray{e.from.position, e.travel};
}

class LightSurroundings {
  public:
    LightSurroundings(Scene const& scene, RenderPlan const& plan);

    // Absent: nothing absorbs and no bodies lie in one another.
    std::optional<Surroundings> at(Scene const& scene, int light, Vector const& origin) const {
        if (!media_) return std::nullopt;
        auto const& known = of_light_[static_cast<std::size_t>(light)];
        return known ? *known : surroundings_at(scene, origin);
    }
    // What is left of a lamp's light where its ray starts.
    static Throughput left(Light const& light, Surroundings const& in, Wavelengths const& wavelengths);

  private:
    bool media_;
    std::vector<std::optional<Surroundings>> of_light_;
};

}  // namespace iride
