// SPDX-License-Identifier: Apache-2.0
#include <catch2/catch.hpp>
#include <set>

#include "base/distribution.h"
#include "base/sampler.h"
#include "support/statistics.h"

using namespace iride;

// Property A of Sobol: every aligned block of 2^k points has one in each elementary interval of area 2^-k.
TEST_CASE("scrambled Sobol points are a (0,2)-sequence", "[law]") {
    for (std::uint32_t seed : {1u, 77u, 3456789123u})
        for (int k = 1; k <= 8; ++k)
            for (int split = 0; split <= k; ++split) {
                std::set<std::uint32_t> cells[sobol_points];
                SobolWords const shuffle = SobolWords{1, 2, 3, 4, 1, 2, 3, 4} * seed;
                SobolWords const scramble = SobolWords{5, 6, 7, 8, 9, 10, 11, 12} * (seed + 0x9e3779b9u);
                for (std::uint32_t i = 0; i < (1u << k); ++i) {
                    SobolWords const p = scrambled_sobol(i, shuffle, scramble);
                    for (int s = 0; s < sobol_points; ++s) {
                        std::uint32_t const x = split ? p[s] >> (32 - split) : 0,
                                            y = k - split ? p[s + sobol_points] >> (32 - (k - split)) : 0;
                        cells[s].insert(x << 16 | y);
                    }
                }
                for (auto const& of_sequence : cells) CHECK(of_sequence.size() == 1u << k);
            }
}

TEST_CASE("random floats are below one and reach every 24-bit value's neighbourhood", "[unit]") {
    CHECK(to_unit_float(0xffffffffu) < 1);
    CHECK(to_unit_float(0) == 0);
}

// Fails for a key without the pixel.
TEST_CASE("a random number depends on seed, pixel, sample and dimension alone", "[law]") {
    auto const number = [](std::uint64_t seed, std::uint32_t pixel, std::uint32_t sample, int dimension) {
        Sampler s(SamplerKind::sobol, seed, pixel, sample);
        for (int i = 0; i < dimension; ++i) s.next2();
        return s.next();
    };
    CHECK(number(1, 2, 3, 4) == number(1, 2, 3, 4));
    CHECK(number(1, 2, 3, 4) != number(2, 2, 3, 4));
    CHECK(number(1, 2, 3, 4) != number(1, 3, 3, 4));
    CHECK(number(1, 2, 3, 4) != number(1, 2, 4, 4));
    CHECK(number(1, 2, 3, 4) != number(1, 2, 3, 5));
}

// Fails for a second number of each pair that equals the first.
TEST_CASE("tabulated distributions sample what they state", "[law]") {
    std::vector<double> const weights{0, 3, 1, 0, 6};
    DiscreteDistribution const d(weights);
    std::vector<double> count(5);
    for (std::uint32_t i = 0; i < 100000; ++i) {
        Sampler s(SamplerKind::sobol, 1, 1, i);
        auto const c = d.sample(s.next());
        ++count[static_cast<std::size_t>(c.index)];
        REQUIRE(c.rest >= 0);
        REQUIRE(c.rest < 1);
    }
    // 1e5 is a sum of six powers of two: six stratified blocks, each off by less than one at either end of an interval.
    for (std::size_t i = 0; i < 5; ++i) CHECK(std::abs(count[i] - weights[i] * 1e4) < 12);
    SquareDistribution const square_distribution(std::vector<double>{1, 0, 2, 5, 3, 1}, 3, 2);
    double mean_inverse = 0;
    for (std::uint32_t i = 0; i < 100000; ++i) {
        Sampler s(SamplerKind::sobol, 2, 1, i);
        auto const p = square_distribution.sample(s.next2());
        REQUIRE(p.density == square_distribution.density(p.x, p.y));
        mean_inverse += 1 / static_cast<double>(p.density) / 1e5;
    }
    CHECK(mean_inverse == Approx(5.0 / 6).epsilon(2e-3));  // one of six cells is never reached
}
