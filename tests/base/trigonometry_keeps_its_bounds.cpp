// SPDX-License-Identifier: Apache-2.0
// The errors that base/trigonometry.h states, against double precision: for every 24-bit number of turns, as the
// sampler makes them, and for angles of every size. Fails when a coefficient is off in its fourth digit.
#include <catch2/catch.hpp>

#include "base/random.h"
#include "base/trigonometry.h"

using namespace iride;

TEST_CASE("sine and cosine of every random number of turns err by less than 1e-7", "[law]") {
    double worst = 0, worst_octant = 0;
    for (int i = 0; i < 1 << 24; ++i) {
        float const t = static_cast<float>(i) * 0x1p-24f;
        auto const [s, c] = sine_cosine_of_turns(t);
        double const angle = 2 * pi_double * static_cast<double>(t);
        worst = std::max({worst, std::abs(static_cast<double>(s) - std::sin(angle)),
                          std::abs(static_cast<double>(c) - std::cos(angle))});
        float const x = (2 * t - 1) * (pi / 4);
        auto const [so, co] = sine_cosine_of_octant(x);
        worst_octant = std::max({worst_octant, std::abs(static_cast<double>(so) - std::sin(static_cast<double>(x))),
                                 std::abs(static_cast<double>(co) - std::cos(static_cast<double>(x)))});
    }
    CHECK(worst < 1e-7);
    CHECK(worst_octant < 6e-8);
}

TEST_CASE("the arctangent errs by less than 2.5e-7, relative", "[law]") {
    double worst = 0;
    for (std::uint32_t i = 0; i < 4000000; ++i) {
        auto const signed_size = [&](std::uint32_t k) {
            std::uint64_t const h = hash_words(i, k);
            float const size = std::exp(16 * to_unit_float(static_cast<std::uint32_t>(h)) - 8);
            return h >> 63 ? -size : size;
        };
        float const y = signed_size(0), x = signed_size(1);
        double const wanted = std::atan2(static_cast<double>(y), static_cast<double>(x));
        worst = std::max(worst, std::abs(static_cast<double>(arctangent(y, x)) / wanted - 1));
    }
    CHECK(worst < 2.5e-7);
    CHECK(arctangent(0.0f, 0.0f) == 0);
    CHECK(arctangent(0.0f, -1.0f) == pi);
}
