// SPDX-License-Identifier: Apache-2.0
// Sums of splats are the same bits in any order, though floating-point sums of the same values are not.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "base/sampler.h"
#include "film/splats.h"

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
    for (int i = 0; i < 4; ++i) forwards.count_path(), backwards.count_path();
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
    for (int i = 0; i < 5; ++i) splats.count_path();
    CHECK(splats.mean(0, 2).X == Approx(0.8));
    CHECK(splats.variance(0, 2).X == Approx((10 - 3.2) / 25));
}

TEST_CASE("a splat too large to be kept is refused", "[unit]") {
    Splats splats(2, 2, 0);
    CHECK(!splats.add(0, 0, {1, 1e9, 1}));
    CHECK(!splats.add(0, 0, {std::nan(""), 1, 1}));
    splats.count_path();
    CHECK(splats.mean(0, 0).X == 0);
}
