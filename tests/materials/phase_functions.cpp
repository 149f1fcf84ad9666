// SPDX-License-Identifier: Apache-2.0
// Henyey and Greenstein's phase function: a density of mean cosine g, sampled as it is.
#include "materials/phase.h"

#include <catch2/catch.hpp>

#include "support/statistics.h"

using namespace iride;

namespace {

Direction const travel = Direction(.3f, -.7f, .5f).normalized();

}  // namespace

// The mean of cos^2 is (1 + 2 g^2) / 3: of Legendre moments 1, g, g^2.
TEST_CASE("scattering has mean cosine g and second moment (1 + 2 g^2) / 3", "[law]") {
    for (float g : {-.8f, -.3f, 0.f, 1e-4f, .5f, .95f}) {
        HenyeyGreenstein const phase(g, travel);
        constexpr std::uint32_t samples = 1 << 16;
        double first = 0, second = 0;
        for (std::uint32_t i = 0; i < samples; ++i) {
            Direction const wi = phase.sample(Sampler(SamplerKind::sobol, 5, 0, i).next2());
            CHECK(std::abs(wi.norm() - 1) < 1e-5f);
            double const c = static_cast<double>(travel.dot(wi));
            first += c / samples;
            second += c * c / samples;
        }
        INFO("g " << g);
        double const wanted = static_cast<double>(g);
        // One point in each of 2^16 strata of the cosine's distribution: error below 2 / 2^16, and that of floats.
        CHECK(first == Approx(wanted).margin(4e-5).epsilon(0));
        CHECK(second == Approx((1 + 2 * wanted * wanted) / 3).margin(4e-5).epsilon(0));
    }
}

TEST_CASE("scattered directions have the density that is stated", "[law]") {
    for (float g : {-.6f, 0.f, .3f, .85f}) {
        HenyeyGreenstein const phase(g, travel);
        test::DirectionHistogram histogram;
        Sampler sampler(SamplerKind::independent, 8, 0, 0);
        for (int i = 0; i < 200000; ++i) histogram.add(phase.sample(sampler.next2()));
        auto const density = [&](Direction const& w) { return static_cast<double>(phase.density(w).value); };
        INFO("g " << g);
        CHECK(histogram.integral_of(density) == Approx(1).epsilon(1e-4));
        CHECK(histogram.p_value(density) > 1e-3 / 4);
    }
}

// 1 / (4 pi) (1 - g^2) / (1 -+ g)^3 = (1 +- g) / (4 pi (1 -+ g)^2), forwards and backwards.
TEST_CASE("forwards and backwards the phase function has its closed forms", "[unit]") {
    for (double g : {-.9, 0., .5, .99}) {
        HenyeyGreenstein const phase(static_cast<float>(g), Direction(0, 0, 1));
        CHECK(phase.density({0, 0, 1}).value == Approx((1 + g) / (4 * pi_double * square(1 - g))).epsilon(2e-5));
        CHECK(phase.density({0, 0, -1}).value == Approx((1 - g) / (4 * pi_double * square(1 + g))).epsilon(2e-5));
    }
}
