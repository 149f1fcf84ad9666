// SPDX-License-Identifier: Apache-2.0
// Sums of splats are the same bits in any order, though floating-point sums of the same values are not.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "base/sampler.h"
#include "film/film.h"
#include "spectral/spectrum.h"

using namespace iride;

TEST_CASE("splats of any size sum to the same bits in any order, and to their sum", "[law]") {
    std::vector<double> values;
    for (std::uint32_t i = 0; i < 3000; ++i) {
        Sampler s(SamplerKind::independent, 51, 0, i);
        values.push_back(std::pow(10.0, 9 * static_cast<double>(s.next()) - 6));
    }
    double exact = 0, plain_forwards = 0, plain_backwards = 0;
    std::vector<double> sorted = values;
    std::ranges::sort(sorted);
    for (double v : sorted) exact += v;
    for (double v : values) plain_forwards += v;
    Splats forwards(2, 2, 1), backwards(2, 2, 1);
    for (double v : values) forwards.add(1, 0, {v, 2 * v, v / 3}), forwards.add_to_band(1, 0, 0, v);
    std::ranges::reverse(values);
    for (double v : values) plain_backwards += v;
    CHECK(plain_forwards != plain_backwards);  // such values do tell orders apart
    for (double v : values) backwards.add(1, 0, {v, 2 * v, v / 3}), backwards.add_to_band(1, 0, 0, v);
    for (int i = 0; i < 4; ++i) forwards.count_paths(1), backwards.count_paths(1);
    CHECK(forwards.mean(1, 0).Y == backwards.mean(1, 0).Y);
    CHECK(forwards.variance(1, 0).Z == backwards.variance(1, 0).Z);
    CHECK(forwards.band(1, 0, 0) == backwards.band(1, 0, 0));
    CHECK(forwards.mean(1, 0).X == Approx(exact / 4).epsilon(1e-9));
    CHECK(forwards.band(1, 0, 0) == Approx(exact / 4).epsilon(1e-9));
    CHECK(forwards.mean(0, 0).X == 0);
}

// N = 5 paths give the splats 3, 1 and three times nothing: mean 4/5, variance of the mean (10 - 16/5) / 25.
TEST_CASE("a splatted mean's variance is that of paths of which most bring nothing", "[unit]") {
    Splats splats(2, 3, 0);
    splats.add(0, 2, {3, 0, 0});
    splats.add(0, 2, {1, 0, 0});
    splats.count_paths(5);
    CHECK(splats.mean(0, 2).X == Approx(0.8));
    CHECK(splats.variance(0, 2).X == Approx((10 - 3.2) / 25));
}

// Light paths of weights 1, 2, 2, 5 bring 3, nothing, 1 and nothing: mean (3 + 2) / 10, variance of the mean
// (3^2 + (2 x 1)^2 - 5^2 x 34 / 100) / 100, as the weights' squares add up to 34.
TEST_CASE("light paths count by the weights of the samples they go with", "[unit]") {
    Splats splats(2, 3, 0);
    for (auto [weight, value] : {std::pair(1u, 3.0), {2u, 0.0}, {2u, 1.0}, {5u, 0.0}}) {
        splats.count_paths(1, weight);
        if (value > 0) splats.add(0, 2, {weight * value, 0, 0});
    }
    CHECK(splats.mean(0, 2).X == Approx(0.5));
    CHECK(splats.variance(0, 2).X == Approx((9 + 4 - 25 * 0.34) / 100));
}

// Of N = 5 paths two bring (3, 1, 0) and (1, 2, 1) to one pixel of six: (sum v v' - sum v sum v'
// / 5) / 25; the camera's samples of the same film add theirs, the sample covariance over n.
TEST_CASE("a pixel's covariance is that of its samples and of its splats", "[unit]") {
    Splats splats(2, 3, 0);
    splats.add(0, 2, {3, 1, 0});
    splats.add(0, 2, {1, 2, 1});
    splats.count_paths(5);
    MatrixDouble const m = splats.covariance(0, 2);
    CHECK(m(0, 1) == Approx((5 - 4 * 3 / 5.0) / 25));
    CHECK(m(1, 2) == Approx((2 - 3 * 1 / 5.0) / 25));
    CHECK(m(2, 0) == Approx((1 - 1 * 4 / 5.0) / 25));
    CHECK(m(0, 0) == Approx(splats.variance(0, 2).X));
    CHECK((m - m.transpose()).norm() == 0);

    WavelengthGrid const grid = WavelengthGrid::covering(visible_range);
    WavelengthSampler const sampler(visible_range, visible_importance(), grid);
    Film camera(1, 1, cie1931_2deg(), grid), both = camera, light = camera;
    both.add_splat_layer();
    light.add_splat_layer();
    for (std::uint32_t i = 0; i < 20; ++i) {
        Sampler random(SamplerKind::independent, 52, 0, i);
        Wavelengths const w = sampler.sample(random.next());
        Radiance const seen(random.next()), splatted(random.next());
        camera.add(0, 0, w, seen);
        both.add(0, 0, w, seen);
        light.add(0, 0, w, Radiance());  // a film without samples has no variance
        for (Film* film : {&both, &light}) {
            film->accompany(0, 0);
            film->count_light_paths(1);
            film->splat(0, 0, w, splatted);
        }
    }
    MatrixDouble const sum = camera.covariance(0, 0) + light.covariance(0, 0);
    CHECK((both.covariance(0, 0) - sum).norm() < 1e-12 * sum.norm());
    CHECK(std::abs(light.covariance(0, 0)(0, 1)) > 0.1 * light.covariance(0, 0)(0, 0));
}

// Pixel 0 has two samples of 1, pixel 1 has as many, and two of 1/2 with light paths that bring 1/2 to both pixels: a
// render that is interrupted, parts that are merged. Fails if splats go to all pixels alike.
TEST_CASE("a pixel takes of light paths what its samples lack", "[law]") {
    WavelengthGrid const grid = WavelengthGrid::covering(visible_range);
    Wavelengths const w = WavelengthSampler(visible_range, visible_importance(), grid).sample(0.4f);
    Bands const bands{visible_range, 1};
    Film whole(2, 1, {0, 0, 2, 1}, cie1931_2deg(), grid, bands), one = whole, joined = whole;
    one.add(0, 0, w, Radiance(1));
    joined.add_splat_layer();
    for (std::uint32_t weight : {1u, 3u}) {
        for (int x : {0, 1}) whole.add(x, 0, w, Radiance(1), weight);
        joined.add(1, 0, w, Radiance(0.5f), weight);
        joined.accompany(1, 0, weight);
        joined.count_light_paths(1, weight);
        for (int x : {0, 1}) joined.splat(x, 0, w, Radiance(0.5f), weight);
    }
    Film const plain = whole;
    whole.add(joined);
    for (int x : {0, 1}) {
        CHECK(whole.mean(x, 0).Y == Approx(one.mean(0, 0).Y));
        CHECK(whole.band(x, 0, 0) == Approx(one.band(0, 0, 0)));
    }
    CHECK(whole.variance(0, 0).Y == Approx(plain.variance(0, 0).Y).margin(1e-12));
    CHECK(whole.covariance(1, 0)(1, 1) == whole.variance(1, 0).Y);
    joined.add(plain);
    CHECK(joined.mean(1, 0).Y == Approx(whole.mean(1, 0).Y));
}

TEST_CASE("splats of two films added up are those of one, to the bit", "[unit]") {
    Splats whole(3, 2, 2), first = whole, second = whole;
    for (std::uint32_t i = 0; i < 200; ++i) {
        Sampler s(SamplerKind::independent, 53, 0, i);
        Xyz const value{static_cast<double>(s.next()), static_cast<double>(s.next()), static_cast<double>(s.next())};
        int const x = static_cast<int>(3 * s.next()), y = static_cast<int>(2 * s.next());
        for (Splats* splats : {&whole, i % 3 == 0 ? &first : &second}) {
            splats->add(x, y, value);
            splats->add_to_band(x, y, 1, value.X);
            splats->count_paths(1);
        }
    }
    first.add(second);
    for (int y = 0; y < 2; ++y)
        for (int x = 0; x < 3; ++x) {
            CHECK(first.mean(x, y).Z == whole.mean(x, y).Z);
            CHECK(first.band(x, y, 1) == whole.band(x, y, 1));
            CHECK((first.covariance(x, y) - whole.covariance(x, y)).norm() == 0);
        }
}

TEST_CASE("a splat too large to be kept is refused", "[unit]") {
    Splats splats(2, 2, 0);
    CHECK(!splats.add(0, 0, {1, 1e9, 1}));
    CHECK(!splats.add(0, 0, {std::nan(""), 1, 1}));
    splats.count_paths(1);
    CHECK(splats.mean(0, 0).X == 0);
}
