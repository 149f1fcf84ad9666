// SPDX-License-Identifier: Apache-2.0
#include "integrators/direct_light.h"

namespace iride {

Radiance DirectLight::at(DirectVertex const& v, Sampler& sampler, RayStatistics& statistics) const {
    if (!v.here.bsdf.has_density()) return {};
    Radiance L;
    for (int i = 0; i < settings_.samples; ++i) switch (settings_.strategy) {
            case DirectStrategy::hemisphere:
            case DirectStrategy::cosine:
                L += by_hemisphere(v, sampler, statistics);
                break;
            case DirectStrategy::bsdf:
                L += by_bsdf(v, sampler, statistics);
                break;
            case DirectStrategy::area:
            case DirectStrategy::solid_angle:
                L += by_lamps(v, sampler, statistics);
                break;
            case DirectStrategy::mis:
                L += by_lamps(v, sampler, statistics);
                L += by_bsdf(v, sampler, statistics);
                break;
        }
    return L * (1 / static_cast<float>(settings_.samples));
}

Radiance DirectLight::by_lamps(DirectVertex const& v, Sampler& sampler, RayStatistics& statistics) const {
    if (settings_.selection) {
        auto const choice = selector_.choose(receiver(v.scene, v.hit, v.here.geometric_normal), sampler.next());
        Sample2 const u = sampler.next2();
        return choice.light >= 0 ? by_lamp(v, choice.light, choice.probability, u, statistics) : Radiance{};
    }
    Radiance L;
    for (int i = 0; i < static_cast<int>(v.scene.lights.size()); ++i)
        L += by_lamp(v, i, 1, sampler.next2(), statistics);
    return L;
}

// A lamp that is asked with probability `choice`.
Radiance DirectLight::by_lamp(DirectVertex const& v, int index, float choice, Sample2 u,
                              RayStatistics& statistics) const {
    Light const& light = v.scene.lights.light(index);
    Vector const& from = v.hit.point.position;
    auto const sample = settings_.strategy == DirectStrategy::area ? light.sample_by_area(from, v.wavelengths, u)
                                                                   : light.sample(from, v.wavelengths, u);
    if (!sample) return {};
    bool const beside_bsdf = settings_.strategy == DirectStrategy::mis;
    return from_lamp(
        v, *sample, choice, [&](LaneDensity const&, float) { return beside_bsdf; }, statistics);
}

// A direction on the viewer's side; where light may come through the surface, on either side.
Radiance DirectLight::by_hemisphere(DirectVertex const& v, Sampler& sampler, RayStatistics& statistics) const {
    bool const uniform = settings_.strategy == DirectStrategy::hemisphere;
    bool const both = !v.scene.material(v.hit.shape->material).traits.two_sided;
    bool const other_side = sampler.next() < 0.5f && both;
    Sample2 const u = sampler.next2();
    Direction wi = uniform ? to_cone(u, 1) : to_cosine_hemisphere(u);
    float const density = (uniform ? cone_density(1) : cosine_hemisphere_density(wi.z())).value * (both ? 0.5f : 1.0f);
    if ((v.here.wo.z() > 0) == other_side) wi.z() = -wi.z();
    Direction const wi_world = v.here.frame.to_world(wi);
    BsdfValue const f = v.here.bsdf.evaluate(v.here.wo, wi).value;
    if (!(density > 0) || is_black(f) || !v.here.is_consistent(wi_world, wi)) return {};
    float const reach = mean(v.state.reach);
    Throughput const weight = v.state.weight * Lanes(f.lane * (std::abs(wi.z()) / density));
    return gathered(v.scene, spawn_ray(v.hit.point, wi_world), behind(v.scene, v.hit, v.here, wi, v.in), v.wavelengths,
                    weight, statistics, [&](int, Hit const*, bool) { return reach; });
}

Radiance DirectLight::by_bsdf(DirectVertex const& v, Sampler& sampler, RayStatistics& statistics) const {
    float const lobe = sampler.next();
    auto const sample = v.here.bsdf.sample(v.here.wo, {lobe, sampler.next2()});
    if (!sample || !sample->density) return {};
    Direction const wi = v.here.frame.to_world(sample->wi);
    if (!v.here.is_consistent(wi, sample->wi)) return {};
    float const reach = mean(v.state.reach * sample->reach);
    float const per_density = mean(v.state.reach) / sample->density->value;
    LightReceiver const from = receiver(v.scene, v.hit, v.here.geometric_normal);
    auto const divisor = [&](int index, Hit const* hit, bool passed) {
        if (settings_.strategy != DirectStrategy::mis || passed) return reach;
        Light const& light = v.scene.lights.light(index);
        float const density =
            (hit ? light.density(from.position, hit->point, hit->primitive) : light.arriving_density(wi)).value;
        return reach + per_density * density * (settings_.selection ? selector_.probability(from, index) : 1);
    };
    return gathered(v.scene, spawn_ray(v.hit.point, wi), behind(v.scene, v.hit, v.here, sample->wi, v.in),
                    v.wavelengths, v.state.weight * sample->weight, statistics, divisor);
}

}  // namespace iride
