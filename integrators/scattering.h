// SPDX-License-Identifier: Apache-2.0
// What the path integrators share: the state of a path, the frame of a closure, emission where a path ends, roulette.
#pragma once

#include <cmath>

#include "integrators/integrator.h"
#include "integrators/shading_normal.h"

namespace iride {

struct PathState {
    Throughput weight{1.0f};  // product of f |cos| / p_hero
    Lanes reach{1.0f};        // product of p_lane / p_hero; 0: this lane could not have come this way
};

// What a material may ask about a meeting, set before its closure is made. `choice`: a random number of its own.
inline void describe_meeting(SurfacePoint& point, Direction const& to_viewer, float choice) {
    point.from_front = to_viewer.dot(point.geometric_normal) > 0;
    point.choice = choice;
}

// Whether the shading normal is that of the geometry.
inline bool is_flat(SurfacePoint const& point) { return point.normal == point.geometric_normal; }

// A surface point met from direction `to_viewer`: closure, and the frame its directions are in.
struct Interaction {
    Bsdf bsdf;
    Frame frame;
    Direction geometric_normal;
    Direction wo;  // local

    // `surroundings`: what the path is in; null if every surface knows what lies before it.
    [[gnu::always_inline]] Interaction(Scene const& scene, Hit const& hit, Direction const& to_viewer,
                                       Wavelengths const& wavelengths, Surroundings const* surroundings = nullptr)
        : Interaction(scene.material(hit.shape->material), hit, to_viewer, wavelengths, surroundings) {}

    // Whether wi (world) leaves on the side of the surface that the local wi says: a shading normal may disagree with
    // the geometry, and light must not leak through.
    bool is_consistent(Direction const& wi_world, Direction const& wi) const {
        return (wi_world.dot(geometric_normal) > 0) == (wi.z() > 0);
    }

  private:
    static Bsdf closure(Material const& material, Hit const& hit, Direction const& to_viewer,
                        Wavelengths const& wavelengths, Surroundings const* surroundings) {
        Body const* const body = surroundings ? material.body() : nullptr;
        if (!body) return material.at(hit.point, wavelengths);
        Medium const& outside = surroundings->in_front_of(*body, to_viewer.dot(hit.point.geometric_normal) > 0);
        return material.at_boundary(hit.point, wavelengths, outside.n.at(wavelengths));
    }
    [[gnu::always_inline]] Interaction(Material const& material, Hit const& hit, Direction const& to_viewer,
                                       Wavelengths const& wavelengths, Surroundings const* surroundings)
        : bsdf(closure(material, hit, to_viewer, wavelengths, surroundings)),
          geometric_normal(hit.point.geometric_normal) {
        float cosine = to_viewer.dot(geometric_normal);
        Direction normal = hit.point.normal;
        if (material.traits.two_sided && cosine < 0) {
            geometric_normal = -geometric_normal;
            normal = -normal;
            cosine = -cosine;
        }
        // Seen from behind the shading normal but before the surface: as good as grazing.
        if (material.traits.two_sided)
            normal = bent_to_viewer(normal, geometric_normal, to_viewer);
        else if ((to_viewer.dot(normal) > 0) != (cosine > 0))
            normal = geometric_normal;
        frame = material.traits.anisotropic ? Frame::along(normal, hit.point.tangent).turned(material.traits.grain)
                                            : Frame::around(normal);
        wo = frame.to_local(to_viewer);
    }
};

// Radiance that the hit surface emits back along the ray.
inline Radiance emitted_at(Scene const& scene, Hit const& hit, Ray const& ray, Wavelengths const& wavelengths) {
    if (hit.shape->light < 0) return {};
    return scene.lights.light(hit.shape->light).emitted(hit.point, -ray.direction, wavelengths);
}

// What lights are chosen for at a vertex, given the geometric normal on the viewer's side: surfaces alike on both sides
// scatter light to the side it comes from.
inline LightReceiver receiver(Scene const& scene, Hit const& hit, Direction const& facing) {
    bool const one_side = scene.material(hit.shape->material).traits.two_sided;
    return {hit.point.position, one_side ? facing : Direction(0, 0, 0)};
}

// The same of what ends the ray, lights at infinity where nothing does.
inline Radiance seen_along(Scene const& scene, Ray const& ray, std::optional<Hit> const& hit,
                           Wavelengths const& wavelengths) {
    if (hit) return emitted_at(scene, *hit, ray, wavelengths);
    Radiance L;
    for (int e : scene.lights.environments()) L += scene.lights.light(e).arriving(ray.direction, wavelengths);
    return L;
}

// Russian roulette: go on with probability q = min(.999, largest lane of the throughput) and divide by q. Throughput is
// weight / mean(reach), which does not depend on which lane is the hero. With q >= the albedo of the last scattering
// the variance is finite (q > rho^2); nothing is cut off. Of 1e7 paths some get into a glass ball at the very angle of
// total reflection, by rounding, and never out: hence not 1. `chance`: by which q is less where little light is left to
// find. [Arvo 1990]
template <bool Dispersive>
bool survives(PathState& state, float u, float chance = 1) {
    float const scale = Dispersive ? float(mean(state.reach)) : 1.0f;
    constexpr float most = 0.999f;
    float const q = std::min(most, largest(state.weight).value / scale) * chance;
    if (!(u < q)) return false;
    state.weight /= q;
    return true;
}

}  // namespace iride
