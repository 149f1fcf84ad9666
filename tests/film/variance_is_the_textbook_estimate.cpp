// SPDX-License-Identifier: Apache-2.0
// The film's mean and its variance: sum (x - mean)^2 / (n (n - 1)), computed here in two passes from the single
// samples.
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <numeric>

#include "base/sampler.h"
#include "base/vector.h"
#include "film/film.h"
#include "spectral/spectrum.h"

using namespace iride;

namespace {

struct Drawn {
    Wavelengths wavelengths;
    Radiance radiance;
};

std::vector<Drawn> draw(int count, float spread) {
    WavelengthSampler const sampler(visible_range, visible_importance(), WavelengthGrid::covering(visible_range));
    std::vector<Drawn> all;
    for (int s = 0; s < count; ++s) {
        Sampler random(SamplerKind::independent, 3, 0, static_cast<std::uint32_t>(s));
        Wavelengths const w = sampler.sample(random.next());
        all.push_back({w, Radiance(1 + spread * random.next())});
    }
    return all;
}

Film empty_film(int width) { return Film(width, 1, cie1931_2deg(), WavelengthGrid::covering(visible_range)); }

}  // namespace

// Fails with the variance of the samples, or with n for n - 1.
TEST_CASE("variance of the mean equals the two-pass estimate", "[unit]") {
    for (int n : {2, 3, 10, 1000})
        for (float spread : {0.0f, 0.001f, 100.0f}) {
            std::vector<Drawn> const drawn = draw(n, spread);
            Film together = empty_film(1), apart = empty_film(n);
            for (int s = 0; s < n; ++s) {
                Drawn const& d = drawn[static_cast<std::size_t>(s)];
                together.add(0, 0, d.wavelengths, d.radiance);
                apart.add(s, 0, d.wavelengths, d.radiance);
            }
            for (double Xyz::*c : {&Xyz::X, &Xyz::Y, &Xyz::Z}) {
                double mean = 0, squares = 0;
                for (int s = 0; s < n; ++s) mean += apart.mean(s, 0).*c / n;
                for (int s = 0; s < n; ++s) squares += square(apart.mean(s, 0).*c - mean);
                INFO(n << " samples, spread " << spread);
                CHECK(together.mean(0, 0).*c == Approx(mean).epsilon(1e-12));
                CHECK(together.variance(0, 0).*c == Approx(squares / n / (n - 1)).epsilon(1e-9));
            }
        }
}

// Samples of variance 1 / w and weight w, at Var(mean) = 1 / sum w. Fails if a square counts once, or by w^2.
TEST_CASE("the variance of samples that weigh by theirs is that of their mean", "[law]") {
    constexpr std::array<std::uint32_t, 12> weights{1, 3, 3, 3, 9, 9, 9, 9, 16, 16, 16, 16};
    constexpr int films = 4000;
    Wavelengths const w = draw(1, 0)[0].wavelengths;
    Film one = empty_film(1);
    one.add(0, 0, w, Radiance(1.0f));
    double const unit = one.mean(0, 0).Y;
    double sum = 0, squares = 0, told = 0;
    for (int f = 0; f < films; ++f) {
        Film film = empty_film(1);
        for (std::uint32_t s = 0; s < weights.size(); ++s) {
            Sampler random(SamplerKind::independent, 5, static_cast<std::uint32_t>(f), s);
            float const noise = std::sqrt(12.0f) * (random.next() - 0.5f);
            film.add(0, 0, w, Radiance(10 + noise / std::sqrt(static_cast<float>(weights[s]))), weights[s]);
        }
        double const mean = film.mean(0, 0).Y / unit;
        sum += mean / films;
        squares += mean * mean / films;
        told += film.variance(0, 0).Y / square(unit) / films;
    }
    double const exact = 1.0 / std::accumulate(weights.begin(), weights.end(), 0u);
    CHECK(sum == Approx(10).epsilon(1e-3));
    CHECK(squares - sum * sum == Approx(exact).epsilon(0.1));
    CHECK(told == Approx(exact).epsilon(0.05));
}

TEST_CASE("of fewer than two samples the variance is unknown", "[unit]") {
    Film film = empty_film(2);
    CHECK(film.mean(0, 0).Y == 0);
    film.add(0, 0, draw(1, 0)[0].wavelengths, Radiance(1.0f));
    CHECK(film.variance(0, 0).Y == std::numeric_limits<double>::infinity());
    CHECK(film.variance(1, 0).Y == std::numeric_limits<double>::infinity());
    CHECK(film.relative_error() == std::numeric_limits<double>::infinity());
}

TEST_CASE("rejected samples are counted by cause and leave the mean alone", "[unit]") {
    Film film = empty_film(1);
    for (Drawn const& d : draw(10, 1)) film.add(0, 0, d.wavelengths, d.radiance);
    double const before = film.mean(0, 0).Y;
    for (int i = 0; i < 3; ++i) film.reject(0, 0, Rejection::negative);
    film.reject(0, 0, Rejection::not_finite);
    CHECK(film.mean(0, 0).Y == before);
    CHECK(film.sample_count(0, 0) == 10);
    CHECK(film.rejected() == std::array<std::uint64_t, rejection_count>{1, 3, 0});
}

// mean of X Y Z over the samples against exact integration; fails when a lane's own density is replaced by the mean
// one.
TEST_CASE("the film's mean is the observer's integral within its own error", "[law]") {
    WavelengthGrid const grid = WavelengthGrid::covering(visible_range);
    WavelengthSampler const sampler(visible_range, visible_importance(), grid);
    TabulatedShape table;  // knots at whole nanometres: the grid holds it exactly
    for (int i = 0; i <= 47; ++i) {
        table.nm.push_back(360 + 10 * i);
        table.value.push_back(1 + std::sin(i));
    }
    SpectralFunction const function(table, Outside::zero);
    Spectrum<dim::spectral_radiance> const spectrum(function, grid);
    Film film = empty_film(1);
    for (std::uint32_t s = 0; s < 100000; ++s) {
        Sampler random(SamplerKind::independent, 4, 0, s);
        Wavelengths const w = sampler.sample(random.next());
        film.add(0, 0, w, spectrum.at(w));
    }
    Xyz const exact = cie1931_2deg().integrate(function), mean = film.mean(0, 0), variance = film.variance(0, 0);
    constexpr double level = 3.6;  // normal quantile of 1e-3 / (2 x 3 components)
    for (double Xyz::*c : {&Xyz::X, &Xyz::Y, &Xyz::Z})
        CHECK(std::abs(mean.*c - exact.*c) < level * std::sqrt(variance.*c));
    double const share =
        variance.X / (square(mean.X) + .01) + variance.Y / (square(mean.Y) + .01) + variance.Z / (square(mean.Z) + .01);
    CHECK(film.relative_error() == Approx(std::sqrt(share / 3)).epsilon(1e-12));
}
