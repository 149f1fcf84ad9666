// SPDX-License-Identifier: Apache-2.0
// Decisions of the plan switched off, one or several: what the scene does not need is carried all the same, so that
// what each saves can be measured and that it changes nothing can be tested.
#pragma once

#include <span>

#include "integrators/plan.h"

namespace iride {

struct PlanSwitch {
    char const* name;     // as in RenderPlan::decisions, or several of them together
    char const* instead;  // what is done when it is off
    bool same_picture;    // bit by bit; else the picture is the same in the mean alone
    // Switch it off; false if this scene needs what it leaves out, so that there is nothing to save.
    bool (*disable)(Scene& scene, RenderPlan& plan);
};
std::span<PlanSwitch const> plan_switches();

// make_plan with these decisions switched off; the scene's shapes are told what to carry. Each is noted among the
// plan's decisions. Throws InputError for an unknown name, with the nearest.
RenderPlan make_plan_without(std::vector<std::string> const& disabled, Scene& scene);

}  // namespace iride
