// SPDX-License-Identifier: Apache-2.0
// Paths through bodies that absorb or lie in one another. On the way to a surface the weight of each lane falls by the
// medium's transmittance, which is no matter of chance: the reach stays. Surfaces that are none, of a body inside one
// of higher priority, are passed without being counted as a scattering.
#pragma once

#include "integrators/scattering.h"
#include "scene/bodies.h"

namespace iride {

// What a ray goes through on its way to a hit, or to infinity.
inline Medium const& medium_before(Scene const& scene, Hit const* hit, Ray const& ray, Surroundings& surroundings) {
    if (Body const* const body = hit ? body_at(scene, *hit) : nullptr)
        surroundings.meet(*body, is_met_in_front(*hit, ray.direction));
    return surroundings.medium();
}

// True if the surface that was met is none: the ray then goes on behind it.
inline bool pass(Scene const& scene, Hit const* hit, Ray& ray, Surroundings& surroundings) {
    Body const* const body = hit ? body_at(scene, *hit) : nullptr;
    bool const front = hit && is_met_in_front(*hit, ray.direction);
    if (!body || !surroundings.is_no_surface(*body, front)) return false;
    surroundings.cross(*body, front);
    ray = spawn_ray(hit->point, ray.direction);
    return true;
}

// Take the weight along the ray to its end; no hit: to infinity. True as pass().
inline bool travel(Scene const& scene, Hit const* hit, Wavelengths const& wavelengths, Ray& ray,
                   Surroundings& surroundings, Throughput& weight) {
    Medium const& medium = medium_before(scene, hit, ray, surroundings);
    weight *= medium.transmittance(hit ? hit->distance : infinity, wavelengths);
    return pass(scene, hit, ray, surroundings);
}

// Follow a ray to the first surface that is one, `hit`, or out of the scene; false if there is no end to surfaces that
// are none. passed(hit) is called for each of those, with the weight that is left there.
template <class Passed>
bool reach_surface(Scene const& scene, Wavelengths const& wavelengths, Ray& ray, Surroundings& surroundings,
                   Throughput& weight, std::optional<Hit>& hit, RayStatistics& statistics, Passed&& passed) {
    hit = scene.accelerator->closest(ray, statistics);
    for (int count = 0; travel(scene, hit ? &*hit : nullptr, wavelengths, ray, surroundings, weight); ++count) {
        passed(*hit);
        if (count == longest_path) return false;
        hit = scene.accelerator->closest(ray, statistics);
    }
    return true;
}

// What a path that comes along wo and goes on along wi, both local, is in then.
inline Surroundings behind(Scene const& scene, Hit const& hit, Interaction const& here, Direction const& wi,
                           Surroundings const& before) {
    Surroundings after = before;
    Body const* const body = body_at(scene, hit);
    if (body && (here.wo.z() > 0) != (wi.z() > 0)) after.cross(*body, here.wo.z() > 0);
    return after;
}

}  // namespace iride
