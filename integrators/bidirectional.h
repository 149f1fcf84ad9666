// SPDX-License-Identifier: Apache-2.0
// Bidirectional path tracing: a path from the camera and one from a light, and all ways to join them:
//   s = 0   the camera's path meets the light          s = 1   a light sample from each of its vertices
//   t = 1   each light vertex is shown to the camera   else    each of its vertices to each light vertex
// weighed against each other and over the lanes by the balance or the power heuristic (integrators/subpath.h). A lamp
// seen directly is left to s = 0, which finds it without noise.   [Lafortune 1993] [Veach 1997, ch. 10] [Wilkie 2014]
#pragma once

#include "integrators/integrator.h"

namespace iride {

std::unique_ptr<Integrator> make_bidirectional(Scene const& scene, RenderPlan const& plan, IntegratorOptions& options);
std::unique_ptr<Integrator> make_bidirectional_power(Scene const& scene, RenderPlan const& plan,
                                                     IntegratorOptions& options);

}  // namespace iride
