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
    std::uint64_t traced_ticks = 0;  // inside Embree, on timed paths
    bool timed = false;
    std::vector<RecordedRay>* recording = nullptr;  // every ray goes here if it is set

    void add(RayStatistics const& other);
    std::uint64_t rays() const { return closest_rays + shadow_rays; }
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

// A place off the surface, on the side of `direction`: 64 units in the last place of the largest coordinate, or of the
// point's size, away (a point computed from barycentrics errs by 3 to 20). A ray from there neither hits nor skips its
// own surface. [Wächter 2019]
inline constexpr float usual_size = 1e-4f;  // m: points near the origin are as uncertain as if they were there
[[gnu::always_inline]] inline Vector off_surface(SurfacePoint const& point, Direction const& direction) {
    float const largest = std::max(point.position.cwiseAbs().maxCoeff(), point.size > 0 ? point.size : usual_size);
    float const offset = 64 * std::numeric_limits<float>::epsilon() * largest;
    float const side = direction.dot(point.geometric_normal) >= 0 ? offset : -offset;
    return point.position + side * point.geometric_normal;
}

// A ray leaving `point` along `direction`.
[[gnu::always_inline]] inline Ray spawn_ray(SurfacePoint const& point, Direction const& direction) {
    return {off_surface(point, direction), direction};
}

// The same towards a place `distance` away, ending just before it.
inline Ray shadow_ray(Vector const& from, Direction const& direction, float distance) {
    constexpr float shortening = 1e-4f;  // relative: keeps the light's own surface out
    return {from, direction, 0, distance * (1 - shortening)};
}
[[gnu::always_inline]] inline Ray spawn_shadow_ray(SurfacePoint const& point, Direction const& direction,
                                                   float distance) {
    return shadow_ray(off_surface(point, direction), direction, distance);
}

}  // namespace iride
