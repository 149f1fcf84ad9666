// SPDX-License-Identifier: Apache-2.0
// Photon methods. A camera path follows mirrors and glass to the first surface that scatters otherwise; there light
// comes from lamps sampled directly, from the caustic map, and from the indirect map, or, by a final gather, from the
// path itself, which scatters once more, follows mirrors and glass again, and asks the maps (or a radiosity solution)
// where it ends. Emission is seen until that scattering only, since lamps are sampled: every path from a lamp to the
// camera is counted once.
//   photon-map           one map, the nearest photons: biased, consistent in photons
//   progressive-photon   a map for every pass: bias and noise vanish with the passes
//   final-gather         the indirect light one scattering farther away, where its errors are averaged
#pragma once

#include "integrators/integrator.h"

namespace iride {

std::unique_ptr<Integrator> make_photon_map(Scene const& scene, RenderPlan const& plan, IntegratorOptions& options);
std::unique_ptr<Integrator> make_progressive_photon(Scene const& scene, RenderPlan const& plan,
                                                    IntegratorOptions& options);
std::unique_ptr<Integrator> make_final_gather(Scene const& scene, RenderPlan const& plan, IntegratorOptions& options);

}  // namespace iride
