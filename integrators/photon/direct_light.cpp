// SPDX-License-Identifier: Apache-2.0
#include "integrators/photon/direct_light.h"

#include "integrators/media.h"

namespace iride {

Radiance direct_light(CachedPoint const& point) {
    Scene const& scene = point.scene;
    if (!scene.lights.has_power()) return {};
    GatherPoint const& at = point.at;
    Interaction const& here = at.here;
    auto const choice = scene.lights.choose(point.light.choice);
    auto const light =
        scene.lights.light(choice.index).sample(at.hit.point.position, point.wavelengths, point.light.place);
    if (!light) return {};
    Direction const wi = here.frame.to_local(light->wi);
    BsdfValue const f = here.bsdf.evaluate(here.wo, wi).value;
    if (is_black(f) || !here.is_consistent(light->wi, wi)) return {};
    if (scene.accelerator->occluded(spawn_shadow_ray(at.hit.point, light->wi, light->distance), point.statistics))
        return {};
    // In units of a steradian: a density for lights of extent, the Dirac's own measure for the others.
    float const density = choice.probability * (light->density ? light->density->value : 1);
    Lanes const scattered(f.lane * (std::abs(wi.z()) / (density * mean(at.state.reach))));
    return at.state.weight * scattered * light->radiance *
           behind(scene, at.hit, here, wi, point.in).medium().transmittance(light->distance, point.wavelengths);
}

}  // namespace iride
