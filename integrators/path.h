// SPDX-License-Identifier: Apache-2.0
// Unidirectional path tracing. `path` combines light sampling with scattering and, where there is dispersion, the lanes
// with one another, all by the balance heuristic. With p_light, p_bsdf the densities of the two strategies:
//   found by scattering:    L += next.weight Le / (mean(next.reach) + mean(state.reach) p_light / p_hero)
//   found by light sample:  L += state.weight f |cos| Le / mean(state.reach (p_bsdf_lane + p_light))
// After a Dirac lobe there is no p_hero and the first line's second term is absent; a Dirac light has no p_bsdf.
// `reference_path` follows the BSDF alone and is the oracle of every other integrator. [Kajiya 1986] [Veach 1997]
// [Wilkie 2014]
#pragma once

#include "integrators/integrator.h"
#include "integrators/plan.h"

namespace iride {

std::unique_ptr<Integrator> make_path(Scene const& scene, RenderPlan const& plan, IntegratorOptions& options);
std::unique_ptr<Integrator> make_reference_path(Scene const& scene, RenderPlan const& plan, IntegratorOptions& options);

}  // namespace iride
