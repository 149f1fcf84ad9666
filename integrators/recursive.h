// SPDX-License-Identifier: Apache-2.0
// Two integrators that follow chains of mirrors and clear glass, and take other surfaces by their direct light alone:
// `recursive` for several generations, each meeting parted into several rays [Whitted 1980]; `direct` for one, with a
// choice among the strategies of integrators/direct_light.h. What is scattered twice by lobes with a density is left
// out, or taken from a radiosity solution.
#pragma once

#include "integrators/integrator.h"

namespace iride {

namespace radiosity {
class RadiosityField;
}

std::unique_ptr<Integrator> make_direct(Scene const& scene, RenderPlan const& plan, IntegratorOptions& options);
std::unique_ptr<Integrator> make_recursive(Scene const& scene, RenderPlan const& plan, IntegratorOptions& options);

// `indirect`: what patches send out of light that came to them from no lamp. `remarks`: what the user is told of it.
std::unique_ptr<Integrator> with_direct_light(Scene const& scene, RenderPlan const& plan,
                                              std::shared_ptr<radiosity::RadiosityField const> indirect,
                                              std::vector<std::string> remarks);

}  // namespace iride
