// SPDX-License-Identifier: Apache-2.0
// What the stages of path tracing leave to one another: a batch of paths goes on together, stage by stage.
#pragma once

#include <array>

#include "integrators/integrator.h"

namespace iride {

// The numbers of the paths of a batch that are still under way.
class Alive {
  public:
    explicit Alive(std::size_t count) : count_(static_cast<int>(count)) {
        for (int i = 0; i < count_; ++i) index_[static_cast<std::size_t>(i)] = i;
    }
    bool none() const { return count_ == 0; }

    // Do `stage` for each; those for which it returns false have ended.
    template <class Stage>
    void keep_if(Stage&& stage) {
        int kept = 0;
        for (int k = 0; k < count_; ++k) {
            int const i = index_[static_cast<std::size_t>(k)];
            index_[static_cast<std::size_t>(kept)] = i;
            kept += stage(static_cast<std::size_t>(i)) ? 1 : 0;
        }
        count_ = kept;
    }
    template <class Stage>
    void for_each(Stage&& stage) const {
        for (int k = 0; k < count_; ++k) stage(static_cast<std::size_t>(index_[static_cast<std::size_t>(k)]));
    }

  private:
    std::array<int, batch_size> index_;
    int count_;
};

// The decisions at a vertex: a block of the sampler.
struct VertexNumbers {
    Sample2 choices;  // x: which light, y: which lobe
    Sample2 light, direction;
    Sample2 chances;  // x: roulette, y: which part of a mixture
};

// What the lamps bring to a batch if nothing stands between, and the rays that tell.
struct Shadows {
    static constexpr std::size_t capacity = 2 * batch_size;  // where a path scatters: that of a lamp and that of a beam
    std::array<ShadowQuery, capacity> query;
    std::array<Radiance, capacity> radiance;
    std::array<CameraPath*, capacity> path;
    std::array<int, capacity> light;
    std::size_t count = 0;

    bool is_full() const { return count == capacity; }

    void add(CameraPath& to, int from, Radiance const& unshadowed, Ray const& ray) {
        query[count].ray = ray;
        radiance[count] = unshadowed;
        light[count] = from;
        path[count++] = &to;
    }
    // Bring what nothing stands in the way of.
    void trace(Scene const& scene, RayStatistics& statistics) {
        scene.accelerator->occluded(std::span(query).first(count), statistics);
        for (std::size_t k = 0; k < count; ++k)
            if (!query[k].occluded) path[k]->bring(light[k], radiance[k]);
        count = 0;
    }
};

// A lamp that is asked for a sample.
struct Asking {
    std::size_t walk;
    LightSelector::Choice choice;
};

// Each light is asked for all its samples at a time; those who ask stand light by light.
inline void answer(Scene const& scene, std::span<Asking const> asking, std::span<LightRequest> requests) {
    for (std::size_t first = 0, last; first < asking.size(); first = last) {
        int const light = asking[first].choice.light;
        for (last = first + 1; last < asking.size() && asking[last].choice.light == light;) ++last;
        scene.lights.light(light).answer(requests.subspan(first, last - first));
    }
}

// What the stages leave to one another; made once for a batch.
struct Exchange {
    std::array<ClosestQuery, batch_size> queries;
    std::array<Asking, batch_size> asking;
    std::array<LightRequest, batch_size> requests;
    Shadows shadows;
};

}  // namespace iride
