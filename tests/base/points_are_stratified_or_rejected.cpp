// SPDX-License-Identifier: Apache-2.0
// Progressive jittered points: one in each square, anywhere in it. Rejection: the density, and the share that is kept.
#include <catch2/catch.hpp>
#include <set>

#include "base/rejection.h"
#include "base/warp.h"
#include "support/statistics.h"

using namespace iride;

// Fails for x and y of the same bits, and for independent points.
TEST_CASE("every aligned block of 4^k stratified points has one in each of 4^k squares", "[unit]") {
    for (std::uint32_t k : {1u, 2u, 3u, 4u, 5u})
        for (std::uint32_t block : {0u, 1u, 7u}) {
            std::uint32_t const count = 1u << (2 * k);
            auto const side = static_cast<float>(1u << k);
            std::set<std::pair<int, int>> squares;
            for (std::uint32_t i = 0; i < count; ++i) {
                Sampler s(SamplerKind::stratified, 5, 17, block * count + i);
                s.next2();
                Sample2 const u = s.next2();
                REQUIRE((u.x >= 0 && u.x < 1 && u.y >= 0 && u.y < 1));
                squares.emplace(static_cast<int>(u.x * side), static_cast<int>(u.y * side));
            }
            CHECK(squares.size() == count);
        }
}

// One block of 16 from each of many pixels: where in their square the points lie.
TEST_CASE("stratified points lie anywhere in their square, in no fixed order", "[law]") {
    constexpr int cells = 8;
    std::vector<double> place(cells * cells), first(16);
    constexpr std::uint32_t pixels = 4000;
    for (std::uint32_t pixel = 0; pixel < pixels; ++pixel)
        for (std::uint32_t i = 0; i < 16; ++i) {
            Sample2 const u = Sampler(SamplerKind::stratified, 6, pixel, i).next2();
            float const x = u.x * 4, y = u.y * 4;
            int const column = static_cast<int>((x - std::floor(x)) * cells),
                      row = static_cast<int>((y - std::floor(y)) * cells);
            ++place[static_cast<std::size_t>(row * cells + column)];
            if (i == 0) ++first[static_cast<std::size_t>(static_cast<int>(y) * 4 + static_cast<int>(x))];
        }
    for (std::vector<double> const& counts : {place, first}) {
        test::ChiSquared verdict;
        double total = 0;
        for (double c : counts) total += c;
        for (double c : counts) verdict.add(total / static_cast<double>(counts.size()), c);
        CHECK(verdict.p_value() > 5e-4);
    }
}

// Shares kept: cos v sin v / pi over [0, 2 pi] x [0, pi/2] below 1 / (2 pi): 2 / pi; the disc in its square: pi / 4.
TEST_CASE("rejection keeps its density and the share that the areas say", "[law]") {
    constexpr int draws = 100000;
    int tries_cosine = 0, tries_disc = 0;
    test::DirectionHistogram directions(10, 20);
    for (int i = 0; i < draws; ++i) {
        Sampler s(SamplerKind::independent, 8, 0, static_cast<std::uint32_t>(i));
        auto const cosine =
            sample_by_rejection([](Sample2 u) { return std::cos(pi / 2 * u.y) * std::sin(pi / 2 * u.y); }, 0.5f, s);
        tries_cosine += cosine.tries;
        float const polar = pi / 2 * cosine.point.y, azimuth = 2 * pi * cosine.point.x;
        directions.add({std::sin(polar) * std::cos(azimuth), std::sin(polar) * std::sin(azimuth), std::cos(polar)});
        tries_disc += sample_by_rejection(
                          [](Sample2 u) { return square(2 * u.x - 1) + square(2 * u.y - 1) < 1 ? 1.0f : 0.0f; }, 1, s)
                          .tries;
    }
    auto const kept = [](int tries) { return static_cast<double>(draws) / tries; };
    // Share p of n draws: standard error of the estimate p sqrt((1 - p) / n), four of it.
    CHECK(std::abs(kept(tries_cosine) - 2 / pi_double) < 4 * 2 / pi_double * std::sqrt((1 - 2 / pi_double) / draws));
    CHECK(std::abs(kept(tries_disc) - pi_double / 4) < 4 * pi_double / 4 * std::sqrt((1 - pi_double / 4) / draws));
    CHECK(directions.p_value(
              [](Direction const& w) { return static_cast<double>(cosine_hemisphere_density(w.z()).value); }) > 1e-3);
}
