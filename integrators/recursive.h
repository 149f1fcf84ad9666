// SPDX-License-Identifier: Apache-2.0
// Two integrators that follow chains of mirrors and clear glass, and take other surfaces by their direct light alone:
// `recursive` for several generations, each meeting parted into several rays [Whitted 1980]; `direct` for one, with a
// choice among the strategies of integrators/direct_light.h. What is scattered twice by lobes with a density is left
// out.
#pragma once

#include "integrators/integrator.h"

namespace iride {

std::unique_ptr<Integrator> make_direct(Scene const& scene, RenderPlan const& plan, IntegratorOptions& options);
std::unique_ptr<Integrator> make_recursive(Scene const& scene, RenderPlan const& plan, IntegratorOptions& options);

}  // namespace iride
