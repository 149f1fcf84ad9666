// SPDX-License-Identifier: Apache-2.0
// The stress suite of bench/measure/stress.cpp in its short form, and in its long one.
#include <catch2/catch.hpp>

#include "bench/measure/stress.h"

namespace {

void check_all(int spp) {
    for (auto const& c : iride::bench::stress(spp)) {
        INFO(c.name << ": found " << c.value << ", allowed " << c.limit);
        CHECK(c.ok);
    }
}

}  // namespace

TEST_CASE("scales, distances, slivers, extreme materials and lamps break no picture", "[law]") { check_all(8); }
TEST_CASE("the same with many samples", "[.stress]") { check_all(1024); }
