// SPDX-License-Identifier: Apache-2.0
// Which integrator `auto` is, from what the scene contains; measured in docs/architecture.md.
#pragma once

#include "integrators/integrator.h"
#include "integrators/plan.h"

namespace iride {

struct IntegratorChoice {
    std::string name, reason;
};
IntegratorChoice choose_integrator(Scene const& scene, RenderPlan const& plan);

std::unique_ptr<Integrator> make_auto(Scene const& scene, RenderPlan const& plan);

}  // namespace iride
