// SPDX-License-Identifier: Apache-2.0
// The rendered ColorChecker against integrals of its tables.
#include <catch2/catch.hpp>

#include "support/colorchecker.h"

using namespace iride;

// Both sides take lamp and reflectance as linear between their points, which is what a renderer carries: that is exact.
// CIE instead sums a lamp with lines at its own 5 nm: what this does to a colour is bounded, too. Under FL2, whose
// lines are 10 nm wide, it fails with wavelengths that are not drawn for the lamp (.11 seen). Fails under another lamp,
// and with a reflectance a per cent off.
TEST_CASE("24 ColorChecker patches rendered under D65, A and FL2 are within CIEDE2000 .02 of direct integration",
          "[law]") {
    for (auto const& [lamp, bound_of_sum] : {std::pair("D65", .005), {"A", .005}, {"FL2", .06}}) {
        test::CheckerErrors const e = test::checker_errors(lamp, 48, 1024);
        INFO(lamp << ": rendered " << e.rendered << ", CIE's sum " << e.summed);
        CHECK(e.rendered < .02);
        CHECK(e.summed < bound_of_sum);
    }
}
