// SPDX-License-Identifier: Apache-2.0
// Paths from the lights alone: every vertex, with the place on the lamp where they start, is shown to the camera. Finds
// caustics at diffuse surfaces at once; cannot find what the camera sees by way of mirrors and glass, nor light from
// infinity seen directly, and says so. [Arvo 1986] [Veach 1997, sec. 10.3]
#pragma once

#include "integrators/integrator.h"

namespace iride {

// Throws InputError for a scene in which no light can be shown to the camera.
std::unique_ptr<Integrator> make_light_tracing(Scene const& scene, RenderPlan const& plan, IntegratorOptions& options);

// Why no integrator that starts paths at lights takes a scene; empty: they do.
std::string why_no_light_paths(Scene const& scene, RenderPlan const& plan);
// Throws InputError that says so of `integrator`.
void check_light_paths_possible(Scene const& scene, RenderPlan const& plan, char const* integrator);

}  // namespace iride
