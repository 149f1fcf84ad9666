// SPDX-License-Identifier: Apache-2.0
// Offsets of samples are distributed as the filter: chi-squared of their distribution against its closed form.
#include "film/filter.h"

#include <catch2/catch.hpp>
#include <functional>
#include <vector>

#include "base/vector.h"
#include "support/statistics.h"

using namespace iride;

namespace {

constexpr double level = 1e-4;  // of each test

// `draw`: offsets. cumulative(x): the share of them below x, over [-limit, limit].
double p_value(double limit, std::function<float(Sample2)> const& draw,
               std::function<double(double)> const& cumulative) {
    constexpr int bins = 60, samples = 200000;
    std::vector<double> count(bins + 1);  // the last: out of the filter
    for (std::uint32_t i = 0; i < samples; ++i) {
        double const x = draw(Sampler(SamplerKind::independent, 31, 0, i).next2());
        double const place = (x + limit) / (2 * limit) * bins;
        ++count[place >= 0 && place < bins ? static_cast<std::size_t>(place) : bins];
    }
    test::ChiSquared verdict;
    for (int b = 0; b < bins; ++b) {
        double const low = limit * (2.0 * b / bins - 1), high = limit * (2.0 * (b + 1) / bins - 1);
        verdict.add(samples * (cumulative(high) - cumulative(low)), count[static_cast<std::size_t>(b)]);
    }
    CHECK(count[bins] == 0);
    return verdict.p_value();
}

}  // namespace

// Fails for a box from 0.
TEST_CASE("box samples are even over the box", "[law]") {
    for (float radius : {0.5f, 2.0f}) {
        double const r = static_cast<double>(radius);
        auto const below = [&](double x) { return (x + r) / (2 * r); };
        CHECK(p_value(
                  r, [&](Sample2 u) { return sample_box(u.x, radius); }, below) > level);
    }
}

// Fails for a box.
TEST_CASE("triangle samples have the density of the tent", "[law]") {
    for (float radius : {1.0f, 1.5f}) {
        double const r = static_cast<double>(radius);
        auto const below = [&](double x) { return x < 0 ? square(1 + x / r) / 2 : 1 - square(1 - x / r) / 2; };
        CHECK(p_value(
                  r, [&](Sample2 u) { return sample_triangle(u.x, radius); }, below) > level);
    }
}

// The squared distance q, in standard deviations: a share (1 - exp(-q / 2)) / (1 - exp(-9 / 2)) lies within it, and the
// azimuth is even. Fails for a standard deviation of half the radius, and for a Gaussian that is not cut.
TEST_CASE("Gaussian samples have the density of a Gaussian cut at three standard deviations", "[law]") {
    float const radius = 1.5f;
    double const r = static_cast<double>(radius), whole = 1 - std::exp(-4.5);
    auto const within = [&](double distance) { return (1 - std::exp(-4.5 * square(distance / r))) / whole; };
    auto const below = [&](double x) { return x < 0 ? 0.0 : within(x); };
    auto const distance = [&](Sample2 u) {
        Sample2 const d = sample_gaussian(u, radius);
        return std::hypot(d.x, d.y);
    };
    CHECK(p_value(r * (1 + 1e-6), distance, below) > level);
    auto const azimuth = [&](Sample2 u) {
        Sample2 const d = sample_gaussian(u, radius);
        return std::atan2(d.y, d.x);
    };
    double const turn = pi_double * (1 + 1e-6);
    CHECK(p_value(turn, azimuth, [&](double x) { return (x + turn) / (2 * turn); }) > level);
}
