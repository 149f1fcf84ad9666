// SPDX-License-Identifier: Apache-2.0
// Approximations of Fresnel's equations, for comparison alone: no material uses them.
//   Schlick          R0 + (1 - R0) (1 - c)^5                                               [Schlick 1994]
//   fast conductor   Rp = (N2 c^2 - 2 n c + 1) / (N2 c^2 + 2 n c + 1), Rs = (N2 - 2 n c + c^2) / (N2 + 2 n c + c^2),
//                    N2 = n^2 + k^2: exact at c = 1 and c = 0, for N2 >> 1 near it between
//   colour shift     a real index n = (1 + sqrt(R0)) / (1 - sqrt(R0)) from the mean R0; the colour goes from that at
//   of 1982          normal incidence to the light's in proportion to (F(c) - F(1)) / (F(0) - F(1)).     [Cook 1982]
#pragma once

#include "materials/fresnel.h"

namespace iride {

inline double schlick(double cosine, double R0) { return R0 + (1 - R0) * std::pow(1 - cosine, 5); }

inline FresnelReflectance<double> fast_conductor(double c, double n, double k) {
    double const N2 = n * n + k * k;
    return {(N2 - 2 * n * c + c * c) / (N2 + 2 * n * c + c * c),
            (N2 * c * c - 2 * n * c + 1) / (N2 * c * c + 2 * n * c + 1)};
}

// The real index with this reflectance at normal incidence; R0 in [0, 1).
inline double index_of_reflectance(double R0) { return (1 + std::sqrt(R0)) / (1 - std::sqrt(R0)); }

// How far the colour of 1982 has gone from the substance's, 0, to the light's, 1.
inline double colour_shift_1982(double cosine, double mean_R0) {
    double const F = fresnel(cosine, index_of_reflectance(mean_R0), 0.0).unpolarised();
    return std::max(0.0, F - mean_R0) / (1 - mean_R0);
}

}  // namespace iride
