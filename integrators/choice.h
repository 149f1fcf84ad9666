// SPDX-License-Identifier: Apache-2.0
// Which integrator `auto` is, from what the scene contains; docs/architecture.md says on what grounds.
#pragma once

#include "integrators/plan.h"

namespace iride {

struct AutomaticChoice {
    std::string name, reason;
    bool trial;  // whether `bidirectional-power` may bring the picture to a given error sooner: to be tried
};
AutomaticChoice choose_integrator(Scene const& scene, RenderPlan const& plan);

}  // namespace iride
