// SPDX-License-Identifier: Apache-2.0
// Ray intersection by Embree (robust mode). The only place, with its .cpp, that knows Embree.
#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "materials/material.h"
#include "scene/ray_cone.h"
#include "scene/shape.h"

namespace iride {

// Shapes in coordinates of their own, placed by instances.
struct ObjectGeometry {
    std::vector<Shape> shapes;
};
struct InstancePlacement {
    int object;
    Transform to_world;
};

// Where a ray ended.
struct Hit {
    SurfacePoint point;
    Shape const* shape;
    std::uint32_t primitive;  // triangle number in a mesh, or half of a quad: (0 1 3), (2 3 1)
    float distance;           // metres along the ray
};

struct ClosestQuery {
    Ray const* ray;
    Hit* hit;
    RayCone cone = {};
    bool found = false;
};
struct ShadowQuery {
    Ray ray;
    bool occluded = false;
};

// A ray as it was asked for, so that a benchmark can trace the same ones bare.
struct RecordedRay {
    Ray ray;
    bool shadow;
};

// Counters of one thread. Every 64th camera path is timed, ray by ray, to tell the share of Embree.
struct RayStatistics {
    std::uint64_t closest_rays = 0, shadow_rays = 0;
    std::uint64_t shared_rays = 0;   // of the latter, those that only tell what neighbours share
    std::uint64_t traced_ticks = 0;  // inside Embree, on timed paths
    bool timed = false;
    std::vector<RecordedRay>* recording = nullptr;  // every ray goes here if it is set

    void add(RayStatistics const& other);
    std::uint64_t rays() const { return closest_rays + shadow_rays; }
    // Rays, each for as much as goes with it: little with those that are shared (measured).
    double work() const {
        constexpr double of_shared = 0.35;
        return static_cast<double>(rays()) - (1 - of_shared) * static_cast<double>(shared_rays);
    }
};

class Accelerator {
  public:
    Accelerator(std::vector<Shape> const& shapes, std::vector<ObjectGeometry> const& objects,
                std::vector<InstancePlacement> const& instances);
    ~Accelerator();
    Accelerator(Accelerator&&) noexcept;

    // The first surface along each ray; false, and `hit` as it was, where there is none. Rays that start and run close
    // together are traced in packets.
    enum class Coherence { none, close };
    void closest(std::span<ClosestQuery> queries, Coherence coherence, RayStatistics& statistics) const;
    std::optional<Hit> closest(Ray const& ray, RayStatistics& statistics) const;

    // Whether something stands in the way of each ray.
    void occluded(std::span<ShadowQuery> queries, RayStatistics& statistics) const;
    bool occluded(Ray const& ray, RayStatistics& statistics) const;

    // Smallest box around everything; empty scene: the origin.
    Vector lower_bound() const;
    Vector upper_bound() const;

    // How many of the rays hit: a loop of rtcIntersect1 and rtcOccluded1 alone, what the benchmarks call bare Embree.
    std::uint64_t trace_bare(std::span<RecordedRay const> rays) const;

  private:
    struct Implementation;
    std::unique_ptr<Implementation> implementation_;
};

// The time stamp counter, or 0 where there is none.
std::uint64_t processor_ticks();

// How far off a surface rays start: 64 units in the last place of the largest coordinate, or of the point's size (a
// point computed from barycentrics errs by 3 to 20). A ray from there neither hits nor skips its own surface.
// [Wächter 2019]
inline constexpr float usual_size = 1e-4f;  // m: points near the origin are as uncertain as if they were there
[[gnu::always_inline]] inline float uncertainty(Vector const& place, float size) {
    constexpr float units = 64 * std::numeric_limits<float>::epsilon();
    return units * std::max(place.cwiseAbs().maxCoeff(), size > 0 ? size : usual_size);
}

// So far, off the surface on the side of `direction`.
[[gnu::always_inline]] inline Vector step_off_surface(SurfacePoint const& point, Direction const& direction,
                                                      float offset) {
    return (direction.dot(point.geometric_normal) >= 0 ? offset : -offset) * point.geometric_normal;
}

// A ray leaving `point` along `direction`.
[[gnu::always_inline]] inline Ray spawn_ray(SurfacePoint const& point, Direction const& direction) {
    return {point.position + step_off_surface(point, direction, uncertainty(point.position, point.size)), direction};
}

// Towards a place `distance` away, ending just before it: the surface there is as uncertain as the one left.
inline Ray shadow_ray(Vector const& from, Direction const& direction, float distance, float uncertain) {
    constexpr float shortening = 1e-4f;  // relative: distances err as well
    return {from, direction, 0, std::max(0.0f, distance * (1 - shortening) - uncertain)};
}
inline Ray shadow_ray(Vector const& from, Direction const& direction, float distance) {
    return shadow_ray(from, direction, distance, uncertainty(from, 0));
}
// The same from a surface. The step off it is nearer to the place, or past it beside a lamp: so it is aimed at anew.
[[gnu::always_inline]] inline Ray spawn_shadow_ray(SurfacePoint const& point, Direction const& direction,
                                                   float distance) {
    float const offset = uncertainty(point.position, point.size);
    Vector const step = step_off_surface(point, direction, offset), origin = point.position + step;
    if (!(distance < infinity)) return {origin, direction};
    Vector const to = distance * direction - step;
    float const length = to.norm();
    return shadow_ray(origin, to / length, length, offset);
}

}  // namespace iride
