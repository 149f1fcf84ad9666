// SPDX-License-Identifier: Apache-2.0
// Light that comes from a lamp without a stop, scattered once by the lobes that have a density:
//   L = integral of f |cos| Le = E[f |cos| Le / p], p by one of six strategies: the directions of a hemisphere (uniform
//   or by the cosine) or of the BSDF; a chosen lamp's area or solid angle; BSDF and solid angle together (`mis`, the
//   balance heuristic of integrators/path.h). Of several lamps one is chosen, or all are added up: the sum, not the
//   mean.
// [Shirley 1996] [Veach 1997]
#pragma once

#include "integrators/media.h"

namespace iride {

enum class DirectStrategy { hemisphere, cosine, bsdf, area, solid_angle, mis };

struct DirectLightSettings {
    DirectStrategy strategy = DirectStrategy::mis;
    std::optional<LightSelection> selection = LightSelection::power;  // absent: all lamps
    int samples = 1;
};

// A vertex of a path: what the estimate needs to know of it.
struct DirectVertex {
    Scene const& scene;
    Hit const& hit;
    Interaction const& here;
    Wavelengths const& wavelengths;
    PathState const& state;
    Surroundings const& in;
};

// What a lamp's sample brings along the path if nothing stands between, the lamp being asked with probability `choice`.
// shares(density, |cos|): how often directions of the BSDF find the same light, 0 .. 1.
template <class Shares>
Radiance from_lamp(DirectVertex const& v, LightSample const& light, float choice, Shares&& shares,
                   RayStatistics& statistics) {
    Direction const wi = v.here.frame.to_local(light.wi);
    float const cosine = std::abs(wi.z());
    BsdfEvaluation const f = v.here.bsdf.evaluate(v.here.wo, wi);
    if (is_black(f.value) || !v.here.is_consistent(light.wi, wi)) return {};
    if (v.scene.accelerator->occluded(spawn_shadow_ray(v.hit.point, light.wi, light.distance), statistics)) return {};
    Lanes competitors(choice);  // for a lamp without extent in its own, Dirac, measure
    if (light.density) {
        float const density = choice * light.density->value;
        float const share = shares(f.density, cosine);
        competitors = Lanes(share * f.density.lane + density);
    }
    Lanes const scattered(f.value.lane * (cosine / mean(v.state.reach * competitors)));
    Throughput const let_through =
        behind(v.scene, v.hit, v.here, wi, v.in).medium().transmittance(light.distance, v.wavelengths);
    return v.state.weight * scattered * let_through * light.radiance;
}

class DirectLight {
  public:
    DirectLight(Scene const& scene, DirectLightSettings const& settings)
        : settings_(settings), selector_(scene.lights, settings.selection.value_or(LightSelection::power)) {}

    // What it brings along the path; draws pairs from the sampler. Only where some light has power.
    Radiance at(DirectVertex const& vertex, Sampler& sampler, RayStatistics& statistics) const;

  private:
    Radiance by_lamps(DirectVertex const& v, Sampler& sampler, RayStatistics& statistics) const;
    Radiance by_lamp(DirectVertex const& v, int light, float choice, Sample2 u, RayStatistics& statistics) const;
    Radiance by_hemisphere(DirectVertex const& v, Sampler& sampler, RayStatistics& statistics) const;
    Radiance by_bsdf(DirectVertex const& v, Sampler& sampler, RayStatistics& statistics) const;

    DirectLightSettings settings_;
    LightSelector selector_;
};

// What a ray brings from the lamps it meets, through surfaces that are none: sum of weight Le / divisor(light, hit,
// passed), where a null hit is an environment and `passed` tells whether surfaces lie between.
template <class Divisor>
Radiance gathered(Scene const& scene, Ray ray, Surroundings in, Wavelengths const& wavelengths, Throughput weight,
                  RayStatistics& statistics, Divisor&& divisor) {
    Radiance L;
    bool passed = false;
    auto const meet = [&](Hit const& hit) {
        if (int const light = hit.shape->light; light >= 0)
            L += weight * emitted_at(scene, hit, ray, wavelengths) * (1 / divisor(light, &hit, passed));
        passed = true;
    };
    std::optional<Hit> hit;
    if (!reach_surface(scene, wavelengths, ray, in, weight, hit, statistics, meet)) return L;
    if (hit) {
        meet(*hit);
        return L;
    }
    for (int e : scene.lights.environments())
        L += weight * scene.lights.light(e).arriving(ray.direction, wavelengths) *
             (1 / divisor(e, static_cast<Hit const*>(nullptr), passed));
    return L;
}

}  // namespace iride
