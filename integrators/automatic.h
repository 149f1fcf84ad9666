// SPDX-License-Identifier: Apache-2.0
// The integrator `auto`: what the plan chose (integrators/choice.h), with camera paths that share what neighbours find
// or are split where a pilot finds noise, whichever a trial finds the better after the first sample; after some samples
// `bidirectional-power`, if another trial tells that it brings the picture to a given error sooner.
#pragma once

#include "integrators/integrator.h"

namespace iride {

inline constexpr std::uint32_t samples_before_sharing = 1, samples_before_joining = 16;

std::unique_ptr<Integrator> make_auto(Scene const& scene, RenderPlan const& plan, IntegratorOptions& options);

}  // namespace iride
