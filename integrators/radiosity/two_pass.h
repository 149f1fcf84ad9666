// SPDX-License-Identifier: Apache-2.0
// Two passes without bias: a radiosity solution as the control variate of a path. With R the reflected radiance of the
// solution and L_r the true one, at every scattering
//   integral of f |cos| L_r = integral of f |cos| R + integral of f |cos| (L_r - R):
// the first by rays among patches alone, which cost little; the second along one path, which goes on with probability q
// and then counts 1 / q times. The mean does not depend on R: the better R, the more rarely may a path go on. Lamps are
// found as in integrators/path.h. [Wallace 1987] [Lafortune 1994]
#pragma once

#include "integrators/radiosity/field.h"
#include "integrators/radiosity/radiosity.h"

namespace iride::radiosity {

struct TwoPassSettings {
    int rays = 4;         // among patches, from where a path scatters first
    float go_on = 0.35f;  // q there; farther along it is the share of light that the scattering keeps
};

// `reflected`: what patches send out without what their lamps emit.
std::unique_ptr<Integrator> two_pass(Scene const& scene, RenderPlan const& plan,
                                     std::shared_ptr<RadiosityField const> reflected, TwoPassSettings const& settings);

std::unique_ptr<Integrator> make_two_pass(Scene const& scene, RenderPlan const& plan, IntegratorOptions& options);

}  // namespace iride::radiosity
