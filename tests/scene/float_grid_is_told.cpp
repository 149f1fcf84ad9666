// SPDX-License-Identifier: Apache-2.0
// A scene too wide for its smallest object is told so at load, with the numbers.
#include <fmt/format.h>
#include <catch2/catch.hpp>

#include "support/scenes.h"

using namespace iride;
using Catch::Matchers::Contains;

namespace {

// Two spheres, `x` apart.
std::vector<std::string> remarks_of_spheres(double x, double radius) {
    auto const sphere = [&](double at) {
        return fmt::format(
            R"({{ "type": "sphere", "centre": [{}, 0, 0], "radius": {}, "material": {{ "type": "black" }} }})", at,
            radius);
    };
    return test::scene_from(fmt::format(R"({{ "camera": {{ "eye": [0, 0, -5], "target": [0, 0, 0], "field_deg": 40 }},
      "shapes": [ {}, {} ] }})",
                                        sphere(0), sphere(x)))
        ->remarks;
}

}  // namespace

// Expected: floats of 1e6 are 2^-4 = .0625 m apart (.12 by epsilon times the number), rays start 64 epsilon = 7.6 m
// off.
TEST_CASE("a scene that is too wide is told the float grid and its smallest object", "[input]") {
    auto const far = remarks_of_spheres(1e6, 0.5);
    REQUIRE(far.size() == 1);
    CHECK_THAT(far[0], Contains("coordinates reach 1e+06 m") && Contains("0.12 m apart") &&
                           Contains("rays start 7.6 m off") && Contains("smallest object measures 1 m"));
    CHECK(remarks_of_spheres(100, 0.5).empty());
    CHECK(remarks_of_spheres(1e6, 1e5).empty());
    CHECK(remarks_of_spheres(0, 1e-3).empty());
}
