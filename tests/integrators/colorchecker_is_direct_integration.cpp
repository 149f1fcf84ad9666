// SPDX-License-Identifier: Apache-2.0
// The rendered ColorChecker against integrals of its tables.
#include <catch2/catch.hpp>

#include "support/colorchecker.h"

using namespace iride;

// Both sides take lamp and reflectance as linear between their points, which is what a renderer carries: that is exact.
// CIE instead sums a lamp with lines at its own 5 nm: what this does to a colour is bounded, too. Fails under another
// lamp, and with a reflectance a per cent off.
TEST_CASE("24 ColorChecker patches rendered under D65 and A are within CIEDE2000 .02 of direct integration", "[law]") {
    for (char const* lamp : {"D65", "A"}) {
        test::CheckerErrors const e = test::checker_errors(lamp, 48, 1024);
        INFO(lamp << ": rendered " << e.rendered << ", CIE's sum " << e.summed << ", sigmas " << e.sigmas);
        CHECK(e.rendered < .02);
        CHECK(e.summed < .005);
    }
}

// Its lines, 10 nm wide, make paths differ: 64 pixels of 1024 paths leave CIEDE2000 .11 of noise, so the error is asked
// to be noise: 4.5 standard deviations in 72 numbers, level 5e-4.
TEST_CASE("24 ColorChecker patches rendered under FL2 are within their noise of direct integration", "[law]") {
    test::CheckerErrors const e = test::checker_errors("FL2", 48, 1024);
    INFO("rendered " << e.rendered << ", CIE's sum " << e.summed << ", sigmas " << e.sigmas);
    CHECK(e.sigmas < 4.5);
    CHECK(e.rendered < .2);
    CHECK(e.summed < .06);
}
