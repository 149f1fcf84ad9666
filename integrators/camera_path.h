// SPDX-License-Identifier: Apache-2.0
// A camera path: what it starts with, and the radiance it brings; and what starts the paths of a picture's pixels.
#pragma once

#include <vector>

#include "base/sampler.h"
#include "integrators/plan.h"
#include "scene/scene.h"

namespace iride {

// What a light path adds to the picture: radiance times square pixels at picture point (x, y).
struct Splat {
    float x, y;
    Radiance radiance;
};

// What a path found, by the group of the light it came from (integrators/light_groups.h).
struct LightShares {
    int const* group_of_light = nullptr;
    Radiance* of_group = nullptr;  // null: nobody asks
};

struct CameraPath {
    float x, y;  // place in the picture, in pixels
    Ray ray;
    RayCone cone;
    Wavelengths wavelengths;
    Sampler sampler{SamplerKind::independent, 0, 0, 0};
    Radiance radiance;
    float part = 1;                     // of its sample that it is
    bool complete = true;               // false: given up (longest_path), the sample must be dropped and counted
    CameraPath const* block = nullptr;  // the first path of its block (Integrator::block_side()); null: it is alone
    LightShares shares;
    std::vector<Splat> splats;  // of the light path that goes with this one, Integrator::splats()

    // Add what one of the scene's lights brings along the path.
    void bring(int light, Radiance const& found) {
        radiance += found * part;
        if (shares.of_group) shares.of_group[shares.group_of_light[light]] += found * part;
    }
};

// Starts path `sample` of pixel (x, y), in place: a point in the pixel drawn from the reconstruction filter, a packet
// of wavelengths, a ray; a function of (seed, pixel, sample) alone.
class PathStarter {
  public:
    PathStarter(Scene const& scene, RenderPlan const& plan, int width, int height, SamplerKind kind,
                std::uint64_t seed);
    // `block`: its first path, whose wavelengths all have; it may be this one.
    void start(int x, int y, std::uint32_t sample, CameraPath& path, CameraPath const* block = nullptr) const;
    // What a splat weighs at the pixels around it, by the filter from which camera paths are drawn: deposit(x, y,
    // weight).
    template <class Deposit>
    void spread(Splat const& splat, Deposit&& deposit) const {
        int const x0 = std::max(0, static_cast<int>(std::floor(splat.x - filter_radius_ - 0.5f))),
                  x1 = std::min(width_ - 1, static_cast<int>(std::floor(splat.x + filter_radius_ + 0.5f))),
                  y0 = std::max(0, static_cast<int>(std::floor(splat.y - filter_radius_ - 0.5f))),
                  y1 = std::min(height_ - 1, static_cast<int>(std::floor(splat.y + filter_radius_ + 0.5f)));
        for (int y = y0; y <= y1; ++y)
            for (int x = x0; x <= x1; ++x) {
                float const weight =
                    filter_at({splat.x - static_cast<float>(x) - 0.5f, splat.y - static_cast<float>(y) - 0.5f});
                if (weight > 0) deposit(x, y, weight);
            }
    }

  private:
    Sample2 place_in_pixel(Sample2 u) const;
    float filter_at(Sample2 offset) const;

    Camera camera_;
    WavelengthSampler wavelengths_;
    FilterKind filter_;
    float filter_radius_;  // pixels
    RayCone cone_;
    int width_, height_;
    SamplerKind kind_;
    std::uint64_t seed_;
};

// What wavelengths are drawn from: the observer's importance or, where a packet is quieter with it, one fitted to the
// lamps; if there are bands, half of it uniform over them.
WavelengthSampler make_wavelength_sampler(Scene const& scene, RenderPlan const& plan);

}  // namespace iride
