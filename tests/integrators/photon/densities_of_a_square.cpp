// SPDX-License-Identifier: Apache-2.0
// Estimators of the density of points on one surface against what they must keep.
#include <catch2/catch.hpp>

#include "base/random.h"
#include "integrators/photon/disc_grid.h"
#include "integrators/photon/surface_density.h"

using namespace iride;

namespace {

std::vector<Vector2> even_points(int count, std::uint64_t seed) {
    std::vector<Vector2> points;
    for (int i = 0; i < count; ++i) {
        std::uint64_t const bits = hash_words(seed, static_cast<std::uint64_t>(i));
        points.emplace_back(to_unit_float(static_cast<std::uint32_t>(bits)),
                            to_unit_float(static_cast<std::uint32_t>(bits >> 32)));
    }
    return points;
}

double integral(SurfaceDensity const& d) {
    constexpr int steps = 64;
    double sum = 0;
    for (int i = 0; i < steps * steps; ++i)
        sum += d.at({(static_cast<float>(i % steps) + 0.5f) / steps, (static_cast<float>(i / steps) + 0.5f) / steps});
    return sum / (steps * steps);
}

}  // namespace

TEST_CASE("the part of a disc in the square has its closed forms", "[unit]") {
    double const r = 0.25;
    CHECK(disc_area_in_square({0.5, 0.5}, r) == Approx(pi_double * r * r).epsilon(1e-12));
    CHECK(disc_area_in_square({0, 0.5}, r) == Approx(pi_double * r * r / 2).epsilon(1e-12));
    CHECK(disc_area_in_square({1, 1}, r) == Approx(pi_double * r * r / 4).epsilon(1e-12));
    CHECK(disc_area_in_square({0.5, 0.5}, 2) == Approx(1).epsilon(1e-12));
    // A segment of height r - d is cut off: r^2 acos(d / r) - d sqrt(r^2 - d^2).
    double const d = 0.1, cut = r * r * std::acos(d / r) - d * std::sqrt(r * r - d * d);
    CHECK(disc_area_in_square({d, 0.5}, r) == Approx(pi_double * r * r - cut).epsilon(1e-12));
}

TEST_CASE("a histogram and a series keep the number of points", "[unit]") {
    auto const points = even_points(500, 1);
    CHECK(integral(HistogramDensity(points, 8)) == Approx(1).epsilon(1e-9));
    CHECK(integral(SeriesDensity(points, 6, SeriesBasis::cosine)) == Approx(1).epsilon(1e-9));
    CHECK(integral(SeriesDensity(points, 6, SeriesBasis::legendre)) == Approx(1).epsilon(2e-3));  // midpoint rule
}

// For an even density inside the square the mean of (k - 1) / (n A(r_k)) is exactly 1 (r_k^2 is a beta variate); k in
// place of k - 1 is 1.05 here. Level: 5 standard errors; each estimate has relative variance 1 / (k - 2).
TEST_CASE("the nearest neighbours of even points have no bias", "[law]") {
    constexpr int k = 20, repetitions = 4000;
    double sum = 0;
    for (int i = 0; i < repetitions; ++i)
        sum += NeighbourDensity(even_points(2000, 100 + static_cast<std::uint64_t>(i)), k, false).at({0.5f, 0.5f});
    CHECK(std::abs(sum / repetitions - 1) < 5 / std::sqrt((k - 2.0) * repetitions));
}

// In a corner the whole disc finds a quarter of the density; the part of the disc inside finds all of it.
TEST_CASE("in a corner the disc's part in the square removes the bias", "[law]") {
    constexpr int k = 20, repetitions = 2000;
    double whole = 0, part = 0;
    for (int i = 0; i < repetitions; ++i) {
        auto const points = even_points(1000, 9000 + static_cast<std::uint64_t>(i));
        whole += NeighbourDensity(points, k, false).at({0, 0});
        part += NeighbourDensity(points, k, true).at({0, 0});
    }
    double const error = 5 / std::sqrt((k - 2.0) * repetitions);
    CHECK(std::abs(part / repetitions - 1) < error);
    CHECK(std::abs(whole / repetitions - 0.25) < error);
}

// Brute force is the independent implementation.
TEST_CASE("the grid finds the nearest entries", "[unit]") {
    std::vector<PhotonGrid::Entry> entries;
    for (std::uint32_t i = 0; i < 3000; ++i) {
        auto const u = [&](std::uint64_t d) { return to_unit_float(static_cast<std::uint32_t>(hash_words(i, d))); };
        entries.push_back({{u(1) * u(4), u(2), u(3) < 0.5f ? 0 : u(3)}, i});
    }
    for (float const cell : {0.01f, 0.07f, 0.5f}) {
        PhotonGrid const grid(entries, cell);
        for (std::uint32_t q = 0; q < 50; ++q) {
            Vector const p = entries[q * 60].position + Vector::Constant(0.003f);
            std::vector<float> distance2;
            for (PhotonGrid::Entry const& e : entries) distance2.push_back((e.position - p).squaredNorm());
            std::sort(distance2.begin(), distance2.end());
            std::vector<PhotonGrid::Neighbour> found;
            float const r2 = grid.nearest(
                p, 2, 30, [](auto const&, float) { return true; }, found);
            CHECK(found.size() == 30);
            CHECK(r2 == distance2[29]);
        }
    }
}

TEST_CASE("the grid finds every disc that reaches over a point once", "[unit]") {
    std::vector<DiscGrid::Disc> discs;
    for (std::uint32_t i = 0; i < 2000; ++i) {
        auto const u = [&](std::uint64_t d) { return to_unit_float(static_cast<std::uint32_t>(hash_words(i, d))); };
        discs.push_back({{u(1) - 0.5f, u(2) - 0.5f, 0.1f * u(3)}, 0.3f * std::pow(u(4), 4.0f) + 1e-6f, i % 3, i});
    }
    DiscGrid const grid(discs);
    for (std::uint32_t q = 0; q < 300; ++q) {
        Vector const p = discs[q * 6].centre + Vector::Constant(0.003f);
        std::vector<std::uint32_t> expected, found;
        for (DiscGrid::Disc const& d : discs)
            if (d.group == q % 3 && (d.centre - p).squaredNorm() < square(d.radius)) expected.push_back(d.index);
        grid.visit(p, q % 3, [&](DiscGrid::Disc const& d, float) { found.push_back(d.index); });
        std::sort(found.begin(), found.end());
        CHECK(found == expected);
    }
}
