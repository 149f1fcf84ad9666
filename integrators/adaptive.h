// SPDX-License-Identifier: Apache-2.0
// Adaptive sampling whose means are unbiased. Stopping a pixel when its own samples look quiet favours those that
// missed something [Kirk 1991]. Here two halves, A and B, have random numbers of their own, and each has a floor and
// more:
//   floor  the same number of samples for every pixel, in both halves, doubled from round to round
//   more   of half A: as many as the floor of half B calls for; of half B: as the floor of A does
// How many samples half A has of a pixel never depends on a value of half A, so the mean over all of them is unbiased,
// and so is the picture, (A + B) / 2 with fixed weights. The one thing that
// looks at all values together is whether there is another round: a pixel's part in that is one in their number.
// Nothing is missed: every pixel has the floor, which grows from round to round, and its noise there and around it (5 x
// 5 pixels) asks for more. The floor's first 16 samples have one in each 1/4 x 1/4 of the pixel: what is half a pixel
// wide is seen from the start, in both halves. At most 16 times the floor is given at a time.
//   relative error:  n = s mean(s) / (2 t^2), s the noise of one sample: the least samples for a mean square
//                    [Neyman 1934]
//   de:              n = (s z / t)^2 / 2, z = 2.576: 1 % of pixels beyond
#pragma once

#include "film/error_target.h"
#include "integrators/render.h"

namespace iride {

struct AdaptiveState {
    std::vector<Film> films;  // floor of A, of B, more of A, of B: see picture_of() in film/checkpoint.h
    int round = 0;            // the one under way
};
AdaptiveState make_adaptive_state(Scene const& scene, std::optional<Crop> const& crop = {});

// Until the target is reached (or the time of `settings` is over, or settings.spp as a mean over pixels is spent). Goes
// on from films and round, which may be of any moment: the rest then comes out in the same bits.
RenderReport render_adaptively(Scene const& scene, RenderPlan const& plan, Integrator& integrator,
                               RenderSettings const& settings, std::optional<ErrorTarget> const& target,
                               std::vector<Film>& films, int& round);

}  // namespace iride
