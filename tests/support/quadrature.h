// SPDX-License-Identifier: Apache-2.0
// Directional albedos by quadrature of evaluate() alone, blind to sample().
#pragma once

#include <array>

#include "materials/bsdf.h"

namespace iride::test {

inline Direction at_angle(double degrees, double azimuth = 0.4) {
    double const t = radians(degrees);
    return VectorDouble(std::sin(t) * std::cos(azimuth), std::sin(t) * std::sin(azimuth), std::cos(t)).cast<float>();
}

// int of f(wo, wi) cos wi over wi, or, with `reversed`, of f(wi, wo) cos wi: the share of light arriving along wo that
// is given back. Midpoint rule in azimuth, two-point Gauss rule in the angle; for smooth lobes.
template <class Model>
Lanes albedo(Model const& model, Direction const& wo, bool reversed = false, int rows = 256, int columns = 256) {
    double const gauss = 0.5 / std::sqrt(3.0);
    std::array<double, lane_count> sum{};
    for (int i = 0; i < rows; ++i)
        for (double side : {-gauss, gauss})
            for (int j = 0; j < columns; ++j) {
                double const x = (i + 0.5 + side) / rows * pi_double / 2, azimuth = 2 * pi_double * (j + 0.5) / columns;
                Direction const wi =
                    VectorDouble(std::sin(x) * std::cos(azimuth), std::sin(x) * std::sin(azimuth), std::cos(x))
                        .cast<float>();
                double const weight = std::sin(x) * std::cos(x) * square(pi_double) / (2.0 * rows * columns);
                BsdfValue const f = reversed ? model.evaluate(wi, wo).value : model.evaluate(wo, wi).value;
                for (int lane = 0; lane < lane_count; ++lane)
                    sum[static_cast<std::size_t>(lane)] += weight * static_cast<double>(f[lane]);
            }
    Lanes result;
    for (int lane = 0; lane < lane_count; ++lane)
        result.set(lane, static_cast<float>(sum[static_cast<std::size_t>(lane)]));
    return result;
}

}  // namespace iride::test
