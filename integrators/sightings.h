// SPDX-License-Identifier: Apache-2.0
// What vertices of light paths show to the camera.
#pragma once

#include <array>
#include <optional>

#include "integrators/integrator.h"
#include "scene/camera_importance.h"

namespace iride {

// What a vertex sends to the camera: a splat, and the ray that must be free.
struct SentToCamera {
    Splat splat;
    Ray shadow_ray;
};

// What the light paths of a batch send to the camera. Their rays are traced together.
class Sightings {
  public:
    void add(CameraPath& path, std::optional<SentToCamera> const& sent, Scene const& scene, RayStatistics& statistics) {
        if (!sent) return;
        queries_[count_].ray = sent->shadow_ray;
        splats_[count_] = sent->splat;
        paths_[count_++] = &path;
        if (count_ == batch_size) trace(scene, statistics);
    }
    // Those that nothing stands in the way of become splats of their paths, in the order they were sent.
    void trace(Scene const& scene, RayStatistics& statistics) {
        scene.accelerator->occluded(std::span(queries_).first(count_), statistics);
        for (std::size_t k = 0; k < count_; ++k)
            if (!queries_[k].occluded) paths_[k]->splats.push_back(splats_[k]);
        count_ = 0;
    }

  private:
    std::array<ShadowQuery, batch_size> queries_;
    std::array<Splat, batch_size> splats_;
    std::array<CameraPath*, batch_size> paths_;
    std::size_t count_ = 0;
};

// `value` at the place of `sight` in the picture, if nothing stands between it and `from`; absent if it is black.
inline std::optional<SentToCamera> send(SurfacePoint const& from, SightOfCamera const& sight, Radiance const& value) {
    if (is_black(value)) return std::nullopt;
    return SentToCamera{{sight.x, sight.y, value}, spawn_shadow_ray(from, sight.towards, sight.distance)};
}

}  // namespace iride
