// SPDX-License-Identifier: Apache-2.0
// Ray intersection by Embree (robust mode). The only place, with its .cpp, that knows Embree.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "materials/material.h"
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
    std::uint32_t primitive;  // triangle number in a mesh
    float distance;           // metres along the ray
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
};

class Accelerator {
  public:
    Accelerator(std::vector<Shape> const& shapes, std::vector<ObjectGeometry> const& objects,
                std::vector<InstancePlacement> const& instances);
    ~Accelerator();
    Accelerator(Accelerator&&) noexcept;

    std::optional<Hit> closest(Ray const& ray, RayStatistics& statistics) const;
    bool occluded(Ray const& ray, RayStatistics& statistics) const;

    // Smallest box around everything; empty scene: the origin.
    Vector lower_bound() const;
    Vector upper_bound() const;

    // The scene as Embree knows it, for the benchmark that traces the same rays bare.
    void* embree_scene() const;

  private:
    struct Implementation;
    std::unique_ptr<Implementation> implementation_;
};

// The time stamp counter, or 0 where there is none.
std::uint64_t processor_ticks();

// A ray leaving `point` along `direction`: its origin is moved off the surface, to the side of the direction, by some
// units in the last place of the coordinates, so that it neither hits nor skips its own surface. [Wächter 2019]
Ray spawn_ray(SurfacePoint const& point, Direction const& direction);
// The same towards a place `distance` away, ending just before it.
Ray spawn_shadow_ray(SurfacePoint const& point, Direction const& direction, float distance);

}  // namespace iride
