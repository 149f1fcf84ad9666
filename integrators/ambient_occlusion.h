// SPDX-License-Identifier: Apache-2.0
// How much of the sky each place would see: (1/pi) integral of V cos over the hemisphere, V = 1 where nothing is nearer
// than a distance; as radiance, the same at every wavelength. It needs no lamps and is no transport of light. Where a
// camera ray meets nothing, it is 0. [Landis 2002]
#pragma once

#include "integrators/integrator.h"

namespace iride {

std::unique_ptr<Integrator> make_ambient_occlusion(Scene const& scene, RenderPlan const& plan,
                                                   IntegratorOptions& options);

}  // namespace iride
