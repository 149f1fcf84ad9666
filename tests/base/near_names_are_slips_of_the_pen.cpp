// SPDX-License-Identifier: Apache-2.0
// A message offers the name that was meant, and none where nothing is near.
#include <catch2/catch.hpp>

#include "base/diagnostics.h"

using namespace iride;

TEST_CASE("a name is near if at most a third of it is wrong, and never all of it", "[unit]") {
    std::vector<std::string> const names{"centre", "radius", "n", "BK7"};
    CHECK(nearest_name("center", names) == "centre");  // neighbours exchanged: one slip
    CHECK(nearest_name("radios", names) == "radius");
    CHECK(nearest_name("radioos", names) == "radius");
    CHECK(nearest_name("ratioos", names).empty());  // 3 of 7
    CHECK(nearest_name("BK", names) == "BK7");
    CHECK(nearest_name("k", names).empty());  // no letter in common with "n"
    CHECK(nearest_name("", names).empty());
    CHECK(nearest_name(std::string(100000, 'x'), names).empty());
    CHECK(suggestion("k", {"n"}) == "; allowed: n");
    CHECK(suggestion("k", {}).empty());
}
