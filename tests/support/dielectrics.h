// SPDX-License-Identifier: Apache-2.0
// Dielectric boundaries and coats for tests, without a scene.
#pragma once

#include <cmath>
#include <map>

#include "materials/plastic.h"

namespace iride::test {

// Reflectance of a dielectric of index n > 1 for unpolarised light from everywhere outside, in closed form. [Walsh
// 1926]
inline double walsh_mean_fresnel(double n) {
    double const n2 = n * n, n4 = n2 * n2, m = n2 - 1, p = n2 + 1;
    return 0.5 + (n - 1) * (3 * n + 1) / (6 * (n + 1) * (n + 1)) +
           n2 * m * m / (p * p * p) * std::log((n - 1) / (n + 1)) - 2 * n * n2 * (n2 + 2 * n - 1) / (p * (n4 - 1)) +
           8 * n4 * (n4 + 1) / (p * (n4 - 1) * (n4 - 1)) * std::log(n);
}

// n from 1.3 to 1.65 in steps of .05, one per lane.
inline Lanes coat_indices() {
    Lanes n;
    for (int i = 0; i < lane_count; ++i) n.set(i, 1.3f + 0.05f * static_cast<float>(i % 8));
    return n;
}

inline CoatAlbedo const& coat_albedo(float alpha) {
    static std::map<float, CoatAlbedo> tables;
    return tables.try_emplace(alpha, Ggx{alpha}, 1.3, 1.65).first->second;
}

// A coat over a base, as PlasticMaterial makes it; alpha 0 for a smooth one.
inline CoatedBase coated_base(Lanes n, Lanes rho, Lanes depth, float alpha) {
    Lanes inside;
    for (int i = 0; i < lane_count; ++i) {
        auto const index = static_cast<double>(n[i]);
        double const outside = alpha > 0 ? coat_albedo(alpha).mean(index) : mean_fresnel(index, 0);
        inside.set(i, static_cast<float>(internal_reflectance(index, outside, static_cast<double>(depth[i]))));
    }
    return {n, depth, radiance_inside(rho, n, inside), 0.9f};
}
inline SmoothPlastic smooth_plastic(Lanes n, Lanes rho, Lanes depth = {}) { return {coated_base(n, rho, depth, 0)}; }
inline RoughPlastic rough_plastic(Lanes n, Lanes rho, float alpha, Lanes depth = {}) {
    return {coated_base(n, rho, depth, alpha), {alpha}, &coat_albedo(alpha)};
}

}  // namespace iride::test
