// SPDX-License-Identifier: Apache-2.0
#include <catch2/catch.hpp>

#include "support/scenes.h"
#include "support/statistics.h"

using namespace iride;

// A constant radiance seen in every band: fails when lanes are deposited with the hero's density.
TEST_CASE("bands of a constant spectrum show no comb over wavelength", "[law]") {
    for (int count : {1, 5, 8, 16, 47}) {
        auto const scene = test::scene_from(
            R"({ "camera": { "eye": [0,0,0], "target": [0,0,1], "field_deg": 30 }, "film": { "size": [32,32], "bands": { "count": )" +
            std::to_string(count) + R"( } }, "lights": [{ "type": "environment", "radiance": 1 }] })");
        Film const film = test::rendered(*scene, "path", {.spp = 64, .seed = 8});
        for (int b = 0; b < count; ++b) {
            double mean = 0, square_sum = 0;
            for (int y = 0; y < 32; ++y)
                for (int x = 0; x < 32; ++x) {
                    mean += film.band(x, y, b) / 1024;
                    square_sum += film.band(x, y, b) * film.band(x, y, b) / 1024;
                }
            double const error = std::sqrt(std::max(0.0, square_sum - mean * mean) / 1023);
            INFO(count << " bands, band " << b);
            CHECK(std::abs(mean - 1) < 4.5 * error + 1e-6);
        }
    }
}

TEST_CASE("lanes follow the density they state", "[law]") {
    WavelengthGrid const grid = WavelengthGrid::covering(visible_range);
    WavelengthSampler const sampler(visible_range, visible_importance(), grid);
    constexpr int bins = 94, draws = 200000;
    std::vector<double> count(bins), expected(bins);
    double integral_of_one = 0;
    for (std::uint32_t i = 0; i < draws; ++i) {
        Sampler s(SamplerKind::independent, 9, 0, i);
        Wavelengths const w = sampler.sample(s.next());
        // Lane 0 alone: lanes of one packet depend on one another.
        ++count[static_cast<std::size_t>(std::min(bins - 1, static_cast<int>((w.nm[0] - 360) / 5)))];
        for (int k = 0; k < lane_count; ++k) {
            integral_of_one += 1.0 / static_cast<double>(w.density[k]) / draws / lane_count;
            REQUIRE(w.nm[k] >= 360);
            REQUIRE(w.nm[k] <= 830);
            REQUIRE(static_cast<double>(w.nm[k]) ==
                    Approx(grid.first_nm + w.cell[k] + static_cast<double>(w.fraction[k])).margin(1e-4));
        }
    }
    CHECK(integral_of_one == Approx(470).epsilon(1e-2));
    // Expected counts from the stated density, by fine stratified sampling of u.
    constexpr int fine = 1 << 20;
    for (int i = 0; i < fine; ++i) {
        Wavelengths const w = sampler.sample((static_cast<float>(i) + 0.5f) / fine);
        expected[static_cast<std::size_t>(std::min(bins - 1, static_cast<int>((w.nm[0] - 360) / 5)))] +=
            static_cast<double>(draws) / fine;
    }
    double statistic = 0;
    for (std::size_t b = 0; b < bins; ++b) statistic += square(count[b] - expected[b]) / std::max(expected[b], 1e-9);
    CHECK(test::chi_squared_tail(statistic, bins - 1) > 1e-3);
    // The density is the derivative of the map.
    for (float u = 0.01f; u < 0.99f; u += 0.013f) {
        Wavelengths const a = sampler.sample(u), b = sampler.sample(u + 1e-4f);
        if (b.nm[0] > a.nm[0])
            CHECK(1e-4 / static_cast<double>(b.nm[0] - a.nm[0]) ==
                  Approx(static_cast<double>(a.density[0])).epsilon(0.05));
    }
}
