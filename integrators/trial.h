// SPDX-License-Identifier: Apache-2.0
// Which of two integrators brings a picture to a given error sooner: a pilot (integrators/pilot.h) follows paths of
// both. With v the variance of a sample of a pixel, m what both find there and T the rays of a sample, the one with the
// lesser
//   T E,   E = mean over the picture of v / m^2                                                          [as relMSE]
#pragma once

#include "integrators/integrator.h"
#include "integrators/pilot.h"

namespace iride {

// The first's over the second's.
struct TrialResult {
    double rays_error;  // rays x error
    double variance;
};
// By `samples` of each of two independent estimates at each place; neighbours stand together where an integrator has
// blocks of pixels. A function of scene, blocks, starter, samples and what the integrators are made for alone.
TrialResult try_out(Scene const& scene, PilotBlocks const& blocks, PilotStarter const& starter, int samples,
                    Integrator const& first, Integrator const& second, RayStatistics& statistics);

}  // namespace iride
