// SPDX-License-Identifier: Apache-2.0
// Bands and XYZ come from the same lanes with the same weights: with an observer that is constant on every band,
//   X = sum over bands of (band radiance x band width x xbar) / (integral of ybar)
// is an identity, sample by sample, whatever radiances and wavelengths were drawn.
#include <catch2/catch.hpp>
#include <cmath>

#include "base/sampler.h"
#include "film/film.h"

using namespace iride;

namespace {

WavelengthGrid const grid = WavelengthGrid::covering(visible_range);

// Random values in 0..1, constant on each band.
SpectralFunction steps(Bands const& bands, Sampler& random) {
    TabulatedShape table;
    table.step = true;
    for (int b = 0; b <= bands.count; ++b) table.nm.push_back(bands.range.min_nm + b * bands.width_nm());
    for (int b = 0; b < bands.count; ++b) table.value.push_back(static_cast<double>(random.next()));
    return {std::move(table), Outside::zero};
}

Observer step_observer(Bands const& bands, Sampler& random) {
    Observer o{"steps", steps(bands, random), steps(bands, random), steps(bands, random), 0};
    o.ybar_integral = o.ybar.integral(bands.range);
    return o;
}

Radiance random_radiance(Sampler& random) {
    Radiance radiance;
    for (int i = 0; i < lane_count; ++i) radiance.set(i, 10 * random.next());
    return radiance;
}

}  // namespace

// Fails when the film interpolates such an observer between whole nanometres, as it does a smooth one.
TEST_CASE("bands times observer are XYZ to rounding, for 1 to 47 bands", "[law]") {
    WavelengthSampler const wavelengths(visible_range, visible_importance(), grid);
    for (int count = 1; count <= 47; ++count) {
        Sampler random(SamplerKind::independent, 1, 0, static_cast<std::uint32_t>(count));
        Bands const bands{visible_range, count};
        Observer const observer = step_observer(bands, random);
        Film film(1, 1, observer, grid, bands);
        for (int s = 0; s < 200; ++s) film.add(0, 0, wavelengths.sample(random.next()), random_radiance(random));
        Xyz sum;
        for (int b = 0; b < count; ++b)
            sum =
                sum + film.band(0, 0, b) * bands.width_nm() / observer.ybar_integral * observer.at(bands.centre_nm(b));
        // Every product is rounded to float twice, 2^-24 each, and is positive: so is the sum's relative error.
        constexpr double rounding = 3 * 0x1p-24;
        INFO(count << " bands");
        CHECK(film.mean(0, 0).X == Approx(sum.X).epsilon(rounding));
        CHECK(film.mean(0, 0).Y == Approx(sum.Y).epsilon(rounding));
        CHECK(film.mean(0, 0).Z == Approx(sum.Z).epsilon(rounding));
    }
}

// Fails when all lanes are weighted with the hero's density.
TEST_CASE("bands of a constant radiance are that radiance, for 1 to 47 bands: no comb", "[law]") {
    WavelengthSampler const wavelengths(visible_range, visible_importance(), grid);
    constexpr int side = 32, pixels = side * side;
    constexpr double level = 4.9;  // normal quantile of 1e-3 / (2 x 1128 bands)
    for (int count = 1; count <= 47; ++count) {
        Film film(side, side, cie1931_2deg(), grid, Bands{visible_range, count});
        for (std::uint32_t p = 0; p < pixels; ++p)
            for (std::uint32_t s = 0; s < 16; ++s) {
                Sampler random(SamplerKind::independent, 2 + static_cast<std::uint64_t>(count), p, s);
                film.add(static_cast<int>(p) % side, static_cast<int>(p) / side, wavelengths.sample(random.next()),
                         Radiance(1.0f));
            }
        for (int b = 0; b < count; ++b) {
            double sum = 0, sum_of_squares = 0;
            for (int p = 0; p < pixels; ++p) {
                double const deviation = film.band(p % side, p / side, b) - 1;
                sum += deviation;
                sum_of_squares += deviation * deviation;
            }
            double const mean = sum / pixels;
            double const error = std::sqrt((sum_of_squares / pixels - mean * mean) / (pixels - 1));
            INFO(count << " bands, band " << b << ": deviation " << mean << ", error " << error);
            CHECK(std::abs(mean) < level * error);
        }
    }
}

TEST_CASE("bands narrower than the sampled range see only their own wavelengths", "[unit]") {
    Bands const bands{{500, 600}, 4};
    Film film(1, 1, cie1931_2deg(), grid, bands);
    Wavelengths w{};
    for (int i = 0; i < lane_count; ++i) {
        w.nm[i] = 400;
        w.density.set(i, 0.01f);
    }
    // Below, at the lower end, inside the last band, at the upper end, above.
    float const nm[] = {499.9f, 500, 587.5f, 600, 600.1f};
    int const used = std::min<int>(lane_count, std::size(nm));
    for (int i = 0; i < used; ++i) w.nm[i] = nm[i];
    film.add(0, 0, w, Radiance(1.0f));
    double const one_lane = 1 / (lane_count * 0.01 * 25);  // 1 / (N p width)
    if (used == 5) {
        CHECK(film.band(0, 0, 0) == Approx(one_lane).epsilon(1e-6));
        CHECK(film.band(0, 0, 1) == 0);
        CHECK(film.band(0, 0, 2) == 0);
        CHECK(film.band(0, 0, 3) == Approx(2 * one_lane).epsilon(1e-6));
    }
    CHECK(bands.centre_nm(0) == 512.5);
    CHECK(bands.centre_nm(3) == 587.5);
}
