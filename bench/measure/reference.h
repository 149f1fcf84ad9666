// SPDX-License-Identifier: Apache-2.0
// Converged pictures that errors are told by. A reference is the mean of two halves, independent renders of the same
// length, so it knows its own error: a and b being the halves, relMSE((a + b) / 2) = relMSE(a, b) / 4.
#pragma once

#include "bench/measure/benchmark.h"
#include "film/compare.h"
#include "integrators/render.h"

namespace iride::bench {

// The size at which errors are told, in pixels.
inline constexpr int picture_size = 256;

// A shipped scene or file at that size.
std::unique_ptr<Scene> load_for_picture(std::string const& name);

struct Reference {
    XyzPicture picture;
    double relmse;        // of the reference itself
    double delta_e_2000;  // mean, of the reference itself: half of that between the halves
};

// From the folder of references, or made now: settings.reference_seconds of `path` for each half, the second in a seed
// of its own. Files are named for scene, size and the scene's hash: one that has changed gets a new reference.
Reference reference_of(Scene const& scene, Settings const& settings);

XyzPicture picture_of(Film const& film);

}  // namespace iride::bench
