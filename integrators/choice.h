// SPDX-License-Identifier: Apache-2.0
// Which integrator `auto` is, from what the scene contains; docs/architecture.md says on what grounds.
#pragma once

#include "integrators/integrator.h"
#include "integrators/plan.h"

namespace iride {

struct AutomaticChoice {
    std::string name, reason;
};
AutomaticChoice choose_integrator(Scene const& scene, RenderPlan const& plan);

std::unique_ptr<Integrator> make_auto(Scene const& scene, RenderPlan const& plan, IntegratorOptions& options);

}  // namespace iride
