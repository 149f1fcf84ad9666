// SPDX-License-Identifier: Apache-2.0
// What a clear coat does with light from everywhere.
//   CoatAlbedo: R(mu) of a GGX boundary, single scattering, F Fresnel's of a dielectric of index n in air:
//     R(mu) = <F(<wo, h>) G2 / G1> over the visible normals,   mean(n) = 2 int_0^1 R(mu) mu dmu
//   For one roughness, linear between knots in mu and in n, by quadrature at load; mean() is exact for the table. What
//   the table errs by is the energy of a white base: < 3e-3 for alpha .05 .. 1, up to 88 degrees (tested).
//   internal_reflectance: R_i, how much of a Lambertian base's light a coat sends back to it. What leaves is what would
//     enter, over n^2 (etendue): R_i = 1 - (1 - mean R) / n^2. A coat of optical depth a takes the factor A(a) / A(0),
//     A(a) = 2 int_0^1 F(mu) exp(-2 a / mu) mu dmu, F from inside; exact for a smooth coat.           [Duntley 1942]
#pragma once

#include <algorithm>
#include <vector>

#include "materials/microfacet.h"
#include "spectral/sampled.h"

namespace iride {

class CoatAlbedo {
  public:
    // Indices least <= n <= most will be asked for, least >= 1.
    CoatAlbedo(Ggx ggx, double least, double most);

    // R, cosine in [0, 1]; n is clamped to the table.
    Lanes reflectance(Lanes const& n, float cosine) const;
    double mean(double n) const;

  private:
    static constexpr int cells = 96;  // between cosines
    int column_count_;                // of indices
    float least_, columns_per_n_;
    float bend_;
    std::vector<float> cosine_;  // [cells + 1], crowded where R varies most: mu <~ alpha, and grazing
    std::vector<float> value_;   // [cells + 1][column_count]
    std::vector<double> mean_;   // [column_count]

    float place(float cosine) const { return std::sqrt(cosine * (1 + bend_) / (cosine + bend_)); }
};

// `outside`: mean R from outside, CoatAlbedo::mean or mean_fresnel. n >= 1, depth >= 0. [dimensionless]
double internal_reflectance(double n, double outside, double optical_depth);

inline Lanes CoatAlbedo::reflectance(Lanes const& n, float cosine) const {
    int const cell = std::clamp(static_cast<int>(static_cast<float>(cells) * place(cosine)), 0, cells - 1);
    auto const row = static_cast<std::size_t>(cell);
    float const part = (cosine - cosine_[row]) / (cosine_[row + 1] - cosine_[row]);
    float const* const lower = value_.data() + row * static_cast<std::size_t>(column_count_);
    float const* const upper = lower + column_count_;
    if (column_count_ == 1) return Lanes(*lower + part * (*upper - *lower));
    Lanes result;
    for (int i = 0; i < lane_count; ++i) {
        float const x = std::clamp((n.lane[i] - least_) * columns_per_n_, 0.0f, static_cast<float>(column_count_ - 1));
        int const c = std::min(static_cast<int>(x), column_count_ - 2);
        float const first = lower[c] + part * (upper[c] - lower[c]);
        float const second = lower[c + 1] + part * (upper[c + 1] - lower[c + 1]);
        result.lane[i] = first + (x - static_cast<float>(c)) * (second - first);
    }
    return result;
}

}  // namespace iride
