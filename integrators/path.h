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

namespace radiosity {
class RadiosityField;
}

// A solution that tells what surfaces send out of light that came to them from no lamp; and what the user is told of
// it.
struct KnownIndirect {
    std::shared_ptr<radiosity::RadiosityField const> field = nullptr;
    std::vector<std::string> remarks{};
};

// Option `splits`: the most parts that a camera path is split into (integrators/splits.h), where it says nothing
// `usual_splits`.
std::unique_ptr<Integrator> path_in_parts(Scene const& scene, RenderPlan const& plan, IntegratorOptions& options,
                                          int usual_splits);
// The same with light paths aimed at mirrors and glass beside it (integrators/aimed_light_paths.h).
std::unique_ptr<Integrator> caustic_path_in_parts(Scene const& scene, RenderPlan const& plan,
                                                  IntegratorOptions& options, int usual_splits);
inline std::unique_ptr<Integrator> make_path(Scene const& scene, RenderPlan const& plan, IntegratorOptions& options) {
    return path_in_parts(scene, plan, options, 1);
}
inline std::unique_ptr<Integrator> make_caustic_path(Scene const& scene, RenderPlan const& plan,
                                                     IntegratorOptions& options) {
    return caustic_path_in_parts(scene, plan, options, 1);
}
// `path` to where it first scatters other than by Dirac lobes: there lamps are sampled, and the rest is known.
std::unique_ptr<Integrator> path_until_known(Scene const& scene, RenderPlan const& plan, KnownIndirect known);
std::unique_ptr<Integrator> make_reference_path(Scene const& scene, RenderPlan const& plan, IntegratorOptions& options);

}  // namespace iride
