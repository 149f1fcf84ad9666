// SPDX-License-Identifier: Apache-2.0
// Whether two pictures are of one expectation, by their own variances.
#pragma once

#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <tuple>

#include "film/film.h"

namespace iride::test {

struct Moments {
    double mean = 0, variance = 0;
};

// Mean of all pixels' X, Y and Z, and the variance of that mean.
inline std::array<Moments, 3> picture_mean(Film const& film) {
    std::array<Moments, 3> m{};
    double const n = film.width() * film.height();
    for (int y = 0; y < film.height(); ++y)
        for (int x = 0; x < film.width(); ++x) {
            Xyz const a = film.mean(x, y), v = film.variance(x, y);
            for (auto [k, value, var] : {std::tuple(0, a.X, v.X), {1, a.Y, v.Y}, {2, a.Z, v.Z}}) {
                m[static_cast<std::size_t>(k)].mean += value / n;
                m[static_cast<std::size_t>(k)].variance += var / (n * n);
            }
        }
    return m;
}

// Per pixel: z of Y beyond 3.3 (two-sided level 1e-3) in no more of 144 pixels than 4; the whole: |z| < 4.
inline void check_same_expectation(Film const& one, Film const& other) {
    CHECK(one.rejected() == std::array<std::uint64_t, rejection_count>{});
    int beyond = 0;
    for (int y = 0; y < one.height(); ++y)
        for (int x = 0; x < one.width(); ++x) {
            double const d = one.mean(x, y).Y - other.mean(x, y).Y, v = one.variance(x, y).Y + other.variance(x, y).Y;
            beyond += d * d > 3.3 * 3.3 * v + 1e-20;
        }
    CHECK(beyond <= 4);
    auto const a = picture_mean(one), b = picture_mean(other);
    for (std::size_t k = 0; k < 3; ++k) {
        double const z = (a[k].mean - b[k].mean) / std::sqrt(a[k].variance + b[k].variance + 1e-30);
        INFO("component " << k << ": " << a[k].mean << " against " << b[k].mean);
        CHECK(std::abs(z) < 4);
        CHECK(b[k].mean > 0.01);
    }
}

}  // namespace iride::test
