// SPDX-License-Identifier: Apache-2.0
// Which directions at a vertex of a camera path are followed, and which are gathered. Narrow are those that scattering
// finds more than T times as often as from a diffuse surface,
//   mean over lanes of p(wi) > T |cos wi| / pi
// They are followed, as through mirrors, with lamps weighed against light samples; photons serve the others. Any such
// rule is right in the mean: a path belongs to one technique, by its directions alone. (The cutoff heuristic of
// [Veach 1997, sec. 9.2.3], with a photon's density that of a diffuse surface.)
#pragma once

#include "base/constants.h"
#include "spectral/sampled.h"

namespace iride {

struct Narrowness {
    float least = 2;  // T

    bool holds(float density, float cosine) const { return density * pi > least * cosine; }
    bool holds(LaneDensity const& density, float cosine) const { return holds(mean(Lanes(density.lane)), cosine); }
};

}  // namespace iride
