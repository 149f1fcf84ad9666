// SPDX-License-Identifier: Apache-2.0
// Converged pictures that errors are told by. A reference is the mean r of two halves a and b, independent renders of
// the same length, so it knows its own error, relMSE(r) = relMSE(a, b) / 4, and leaves it out of that of a picture p:
//   relMSE(p) = mean over pixels and X, Y, Z of (p - a) (p - b) / (r^2 + .01)
// whose expectation is that of (p - truth)^2, as the errors of p, a and b are independent.
#pragma once

#include <array>

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
    std::array<XyzPicture, 2> half;
    double relmse;        // of the reference itself
    double delta_e_2000;  // mean, of the reference itself: half of that between the halves

    double relmse_of(XyzPicture const& p) const;
};

// From the folder of references, or made now: settings.reference_seconds of `path` for each half, the second in a seed
// of its own. Files are named for scene, size and the scene's hash: one that has changed gets a new reference.
Reference reference_of(Scene const& scene, Settings const& settings);

XyzPicture picture_of(Film const& film);

}  // namespace iride::bench
