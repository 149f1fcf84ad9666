// SPDX-License-Identifier: Apache-2.0
// Oren and Nayar's model in its energy-preserving form: white is white, smooth is Lambert's, samples have bounded
// weight.
#include <catch2/catch.hpp>

#include "materials/lambert.h"
#include "materials/oren_nayar.h"
#include "support/quadrature.h"

using namespace iride;

namespace {

constexpr std::array<float, 6> roughnesses{0, .001f, .2f, .5f, .8f, 1};

// What one bounce gives back for rho = 1: (1 + r s/t) / (1 + c1 r) over cosine-weighted directions, by midpoints.
double one_bounce(double r, double angle) {
    constexpr int steps = 400;
    double const c1 = 0.5 - 2 / (3 * pi_double), mu = std::cos(radians(angle)), sine = std::sin(radians(angle));
    double sum = 0;
    for (int i = 0; i < steps; ++i)
        for (int j = 0; j < steps; ++j) {
            double const sine_i = std::sqrt((i + 0.5) / steps), mu_i = std::sqrt(1 - square(sine_i));
            double const s = sine * sine_i * std::cos(2 * pi_double * (j + 0.5) / steps);
            sum += 1 + r * s / (s > 0 ? std::max(mu, mu_i) : 1);
        }
    return sum / (square(static_cast<double>(steps)) * (1 + c1 * r));
}

}  // namespace

// Fails without the lobe of several bounces, and for t = 1 everywhere.
TEST_CASE("a white rough diffuse surface stays white at every roughness and angle", "[law]") {
    for (float r : roughnesses)
        for (double angle : {0., 20., 45., 70., 85., 89.9}) {
            OrenNayar const white{Lanes(1), r};
            INFO("roughness " << r << " at " << angle);
            CHECK(test::albedo(white, test::at_angle(angle))[0] == Approx(1).margin(5e-4));
        }
}

// By the series of bounces, E(wo) and E the shares that escape after the first and after each further one: rho E(wo) +
// (1 - E(wo)) E rho^2 / (1 - rho (1 - E)). Fails for rho instead of rho^2.
TEST_CASE("a grey rough surface absorbs at every bounce", "[law]") {
    Lanes rho;
    for (int i = 0; i < lane_count; ++i) rho.set(i, static_cast<float>(i + 1) / lane_count);
    double const c1 = 0.5 - 2 / (3 * pi_double), c2 = 2.0 / 3 - 28 / (15 * pi_double);
    for (double r : {.3, 1.0})
        for (double angle : {0., 60., 85.}) {
            OrenNayar const model{rho, static_cast<float>(r)};
            double const once = one_bounce(r, angle), mean = (1 + c2 * r) / (1 + c1 * r);
            Lanes const found = test::albedo(model, test::at_angle(angle));
            for (int i = 0; i < lane_count; ++i) {
                double const p = static_cast<double>(rho[i]);
                double const expected = p * once + (1 - once) * mean * p * p / (1 - p * (1 - mean));
                CHECK(found[i] == Approx(expected).margin(1e-3));
            }
        }
}

TEST_CASE("a diffuse surface without roughness is Lambert's", "[unit]") {
    Lambert const lambert{Lanes(0.4f)};
    OrenNayar const smooth{Lanes(0.4f), 0};
    for (double a : {0., 30., 80.})
        for (double b : {10., 60., 89.}) {
            auto const x = smooth.evaluate(test::at_angle(a), test::at_angle(b, 2.0)),
                       y = lambert.evaluate(test::at_angle(a), test::at_angle(b, 2.0));
            CHECK(x.value[0] == Approx(y.value[0]).epsilon(1e-6));
            CHECK(x.density[0] == Approx(y.density[0]).epsilon(1e-6));
        }
}

// Oren and Nayar's effect: a full moon is flat. Fails for the sign of s turned over.
TEST_CASE("a rough surface sends more light back to where it came from than ahead", "[unit]") {
    OrenNayar const rough{Lanes(0.5f), 1};
    Direction const wo = test::at_angle(70, 0);
    CHECK(rough.evaluate(wo, test::at_angle(60, 0)).value[0] >
          2 * rough.evaluate(wo, test::at_angle(60, pi_double)).value[0]);
}

// Fails for cosine sampling alone.
TEST_CASE("a sample of a white rough diffuse surface weighs at most 1.3", "[law]") {
    for (float r : roughnesses)
        for (double angle : {0., 45., 80., 89., 89.99}) {
            OrenNayar const white{Lanes(1), r};
            float largest_weight = 0;
            for (std::uint32_t i = 0; i < 4096; ++i) {
                Sampler s(SamplerKind::sobol, 3, 1, i);
                auto const x = white.sample(test::at_angle(angle), {s.next(), s.next2()});
                if (x) largest_weight = std::max(largest_weight, x->weight[0]);
            }
            INFO("roughness " << r << " at " << angle << ": " << largest_weight);
            CHECK(largest_weight <= 1.3f);
        }
}
