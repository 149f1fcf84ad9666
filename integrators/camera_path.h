// SPDX-License-Identifier: Apache-2.0
// A camera path: what it starts with, and the radiance it brings; and what starts the paths of a picture's pixels.
#pragma once

#include "base/sampler.h"
#include "integrators/plan.h"
#include "scene/scene.h"

namespace iride {

struct CameraPath {
    Ray ray;
    RayCone cone;
    Wavelengths wavelengths;
    Sampler sampler{SamplerKind::independent, 0, 0, 0};
    Radiance radiance;
    bool complete = true;  // false: given up (longest_path), the sample must be dropped and counted
};

// Starts path `sample` of pixel (x, y), in place: a point in the pixel drawn from the reconstruction filter, a packet
// of wavelengths, a ray; a function of (seed, pixel, sample) alone.
class PathStarter {
  public:
    PathStarter(Scene const& scene, RenderPlan const& plan, int width, int height, SamplerKind kind,
                std::uint64_t seed);
    void start(int x, int y, std::uint32_t sample, CameraPath& path) const;

  private:
    Sample2 place_in_pixel(Sample2 u) const;

    Camera camera_;
    WavelengthSampler wavelengths_;
    FilterKind filter_;
    float filter_radius_;  // pixels
    RayCone cone_;
    int width_;
    SamplerKind kind_;
    std::uint64_t seed_;
};

// What wavelengths are drawn from: the observer's importance or, where a packet is quieter with it, one fitted to the
// lamps; if there are bands, half of it uniform over them.
WavelengthSampler make_wavelength_sampler(Scene const& scene, RenderPlan const& plan);

}  // namespace iride
