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

// Options of camera paths.
struct PathHabits {
    int splits = 1;      // the most parts that one is split into (integrators/splits.h)
    bool share = false;  // neighbours share second vertices (integrators/shared_vertices.h), where the scene lets them
};
// `usual`: where the options say nothing.
PathHabits habits_asked_for(IntegratorOptions& options, PathHabits const& usual = {});
std::unique_ptr<Integrator> path_by(PathHabits const& habits, Scene const& scene, RenderPlan const& plan,
                                    IntegratorOptions& options);
// The same with light paths aimed at mirrors and glass beside it (integrators/aimed_light_paths.h).
std::unique_ptr<Integrator> caustic_path_by(PathHabits const& habits, Scene const& scene, RenderPlan const& plan,
                                            IntegratorOptions& options);
inline std::unique_ptr<Integrator> make_path(Scene const& scene, RenderPlan const& plan, IntegratorOptions& options) {
    return path_by(habits_asked_for(options), scene, plan, options);
}
inline std::unique_ptr<Integrator> make_caustic_path(Scene const& scene, RenderPlan const& plan,
                                                     IntegratorOptions& options) {
    return caustic_path_by(habits_asked_for(options), scene, plan, options);
}
// `path` to where it first scatters other than by Dirac lobes: there lamps are sampled, and the rest is known.
std::unique_ptr<Integrator> path_until_known(Scene const& scene, RenderPlan const& plan, KnownIndirect known);
std::unique_ptr<Integrator> make_reference_path(Scene const& scene, RenderPlan const& plan, IntegratorOptions& options);

}  // namespace iride
