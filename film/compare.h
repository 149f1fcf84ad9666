// SPDX-License-Identifier: Apache-2.0
// How far two pictures are apart, in XYZ.
#pragma once

#include "film/exr.h"

namespace iride {

inline constexpr double relmse_floor = 0.01;  // keeps black pixels from ruling the mean

struct Comparison {
    int width, height;
    double mse, rmse;                            // mean over pixels and X, Y, Z of (a - b)^2, and its root
    double relmse;                               // ... of (a - b)^2 / (b^2 + relmse_floor), b the second picture
    double delta_e_2000_mean, delta_e_2000_max;  // CIEDE2000 of Lab under white D65 with Y = 1
};

// Throws InputError if the sizes differ.
Comparison compare(XyzPicture const& a, XyzPicture const& b);

}  // namespace iride
