// SPDX-License-Identifier: Apache-2.0
// An integrator estimates the spectral radiance that arrives along a ray. It is pure: no camera, no film, no state.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>

#include "base/sampler.h"
#include "scene/scene.h"

namespace iride {

struct RenderPlan;

// One camera path's radiance; `complete` is false if the path was given up (longest_path), and the sample must be
// dropped and counted.
struct PathResult {
    Radiance radiance;
    bool complete = true;
};

class Integrator {
  public:
    virtual ~Integrator() = default;
    virtual PathResult radiance(Scene const& scene, Ray ray, Wavelengths const& wavelengths, Sampler& sampler,
                                RayStatistics& statistics) const = 0;
};

struct IntegratorEntry {
    char const* name;
    char const* summary;
    std::unique_ptr<Integrator> (*make)(RenderPlan const&);
};
std::span<IntegratorEntry const> integrator_entries();
// Throws InputError with the nearest name.
std::unique_ptr<Integrator> make_integrator(std::string const& name, RenderPlan const& plan);

// A path that scatters this often in a scene without absorption would never end: it is given up and counted.
inline constexpr int longest_path = 10000;

}  // namespace iride
