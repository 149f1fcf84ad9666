// SPDX-License-Identifier: Apache-2.0
// The stated bound, against the standard library's error function.
#include "base/error_function.h"

#include <catch2/catch.hpp>

using namespace iride;

TEST_CASE("the inverse error function keeps its bound", "[unit]") {
    double worst = 0;
    for (int i = 1; i < 200000; ++i) {
        double const x = 3.4 * i / 200000;
        auto const y = static_cast<float>(std::erf(x));
        if (!(y < 1 - 1e-6f)) break;
        double exact = x;  // of y as rounded, by Newton's method
        for (int newton = 0; newton < 4; ++newton)
            exact -= (std::erf(exact) - static_cast<double>(y)) * std::sqrt(M_PI) / 2 * std::exp(exact * exact);
        double const found = static_cast<double>(inverse_error_function(y));
        worst = std::max(worst, std::abs(found - exact) / (1 + exact));
        CHECK(inverse_error_function(-y) == -inverse_error_function(y));
    }
    INFO("largest error " << worst);
    CHECK(worst < 5e-7);
    CHECK(std::isfinite(inverse_error_function(1)));
    CHECK(std::isfinite(inverse_error_function(-1)));
}
