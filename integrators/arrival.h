// SPDX-License-Identifier: Apache-2.0
// How the ray at hand was chosen, and what lamps bring where it ends: light that a sample of the lamp, taken where the
// ray set out, would have brought as well is weighed by the balance heuristic over lanes and both techniques,
//   Le weight / (mean(next.reach) + mean(state.reach) p_light / p_hero)
#pragma once

#include "integrators/scattering.h"

namespace iride {

struct Arrival {
    std::optional<PerSteradian> density{};  // p_hero, times how often; absent: light samples do not compete, as from
                                            // the camera and after a Dirac lobe
    LightReceiver from{};
    float mean_reach_before = 1;
};

// Radiance along the path from the surface that was hit, or from infinity. chosen(light): the probability with which a
// light sample asks that light.
template <class Chosen>
Radiance lamps_met(Scene const& scene, Ray const& ray, Hit const* hit, Wavelengths const& wavelengths,
                   PathState const& state, Arrival const& arrival, Chosen&& chosen) {
    auto const weighed = [&](Radiance const& Le, int light, auto&& density) {
        if (is_black(Le)) return Radiance();
        float divisor = mean(state.reach);
        if (arrival.density)
            divisor += arrival.mean_reach_before * chosen(light) * density().value / arrival.density->value;
        return state.weight * Le * (1 / divisor);
    };
    if (hit) {
        int const light = hit->shape->light;
        if (light < 0) return {};
        return weighed(emitted_at(scene, *hit, ray, wavelengths), light, [&] {
            return scene.lights.light(light).density(arrival.from.position, hit->point, hit->primitive);
        });
    }
    Radiance L;
    for (int e : scene.lights.environments()) {
        Light const& light = scene.lights.light(e);
        L += weighed(light.arriving(ray.direction, wavelengths), e,
                     [&] { return light.arriving_density(ray.direction); });
    }
    return L;
}

}  // namespace iride
