// SPDX-License-Identifier: Apache-2.0
#include "integrators/aimed_light_paths.h"

#include <fmt/format.h>

#include "integrators/light_tracing.h"

namespace iride {

AimedLightPaths light_paths_asked_for(Scene const& scene, RenderPlan const& plan, IntegratorOptions& options,
                                      char const* integrator) {
    check_light_paths_possible(scene, plan, integrator);
    AimedEmission aimed(scene);
    if (!aimed.has_targets())
        throw InputError({}, "integrator",
                         fmt::format("'{}' cannot render this scene: no lamp of a place shines at a mirror or a glass; "
                                     "'path' can",
                                     integrator));
    auto const share = options.number("light_paths", {.least = 0, .most = 1, .least_excluded = true});
    return AimedLightPaths(scene, plan, std::move(aimed), share);
}

}  // namespace iride
