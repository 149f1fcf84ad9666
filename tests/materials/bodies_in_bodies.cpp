// SPDX-License-Identifier: Apache-2.0
// The list of bodies around a path: which medium a place has, and which surfaces are none.
#include <catch2/catch.hpp>

#include "base/constants.h"
#include "materials/medium.h"

using namespace iride;

namespace {

Body body(std::optional<int> priority) { return {Medium{Index(1.5f)}, {}, priority}; }

}  // namespace

// Fails when the body entered last fills the place.
TEST_CASE("of two bodies the one of the higher priority fills the place, whichever is entered first", "[unit]") {
    Body const glass = body(2), water = body(1);
    Surroundings in;
    CHECK(&in.medium() == &vacuum);
    CHECK(!in.is_no_surface(water, true));
    CHECK(&in.in_front_of(water, true) == &vacuum);
    in.cross(water, true);
    CHECK(&in.medium() == &water.inside);
    CHECK(!in.is_no_surface(glass, true));
    CHECK(&in.in_front_of(glass, true) == &water.inside);
    in.cross(glass, true);
    CHECK(&in.medium() == &glass.inside);
    CHECK(in.is_no_surface(water, false));  // leaving the water inside the glass
    in.cross(water, false);
    CHECK(&in.medium() == &glass.inside);
    CHECK(!in.is_no_surface(glass, false));
    CHECK(&in.in_front_of(glass, false) == &vacuum);
    CHECK(in.is_no_surface(water, true));  // and back
    in.cross(water, true);
    CHECK(&in.medium() == &glass.inside);
    CHECK(&in.in_front_of(glass, false) == &water.inside);
    in.cross(glass, false);
    CHECK(&in.medium() == &water.inside);
}

TEST_CASE("between bodies of one material there is no surface", "[unit]") {
    Body const glass = body(0);
    Surroundings in;
    in.cross(glass, true);
    CHECK(in.is_no_surface(glass, true));
    in.cross(glass, true);
    CHECK(in.is_no_surface(glass, false));
    in.cross(glass, false);
    CHECK(!in.is_no_surface(glass, false));
    CHECK(&in.medium() == &glass.inside);
    in.cross(glass, false);
    CHECK(&in.medium() == &vacuum);
}

// Fails when what is met from behind is not taken to be around, and when what was left stays in the list.
TEST_CASE("a body that is left without having been entered was around the path, and is gone then", "[unit]") {
    Body const glass = body(1), water = body(2);
    Surroundings in;
    in.meet(glass, false);
    CHECK(&in.medium() == &glass.inside);
    CHECK(!in.is_no_surface(glass, false));
    CHECK(&in.in_front_of(glass, false) == &vacuum);
    in.cross(glass, false);
    CHECK(in == Surroundings());
    in.meet(water, true);
    CHECK(in == Surroundings());
}

TEST_CASE("bodies beyond the list's capacity do not exist for a path", "[unit]") {
    std::vector<Body> nested;
    for (int i = 0; i < 2 * Surroundings::capacity; ++i) nested.push_back(body(i));
    Surroundings in;
    for (int i = 0; i < 2 * Surroundings::capacity; ++i) {
        in.meet(nested[static_cast<std::size_t>(i)], true);
        CHECK(in.is_no_surface(nested[static_cast<std::size_t>(i)], true) == (i >= Surroundings::capacity));
        in.cross(nested[static_cast<std::size_t>(i)], true);
    }
    CHECK(&in.medium() == &nested[Surroundings::capacity - 1].inside);
    for (std::size_t i = nested.size(); i-- > 0;) {
        in.meet(nested[i], false);
        CHECK(in.is_no_surface(nested[i], false) == (i >= Surroundings::capacity));
        in.cross(nested[i], false);
    }
    CHECK(in == Surroundings());
}

// Fails when an interface keeps its inner medium after it was left.
TEST_CASE("an interface without a priority tells what is on its two sides, and then the list speaks again", "[unit]") {
    Body const water = body(1);
    Body ball = body({});
    Surroundings in;
    in.cross(water, true);
    CHECK(!in.is_no_surface(ball, true));
    CHECK(&in.in_front_of(ball, true) == &ball.outside);
    in.cross(ball, true);
    CHECK(&in.medium() == &ball.inside);
    in.cross(ball, false);
    CHECK(&in.medium() == &water.inside);
    ball.outside.absorbs = true;
    in.cross(ball, false);
    CHECK(&in.medium() == &ball.outside);
}

TEST_CASE("light falls as exp(-sigma_a d), and not a ray is left of it from infinity", "[unit]") {
    Medium medium{Index(1.0f), Absorption(2.0f), true};
    Wavelengths const w{};
    CHECK(medium.transmittance(.75f, w)[0] == Approx(std::exp(-1.5)).epsilon(1e-6));
    CHECK(medium.transmittance(0, w)[0] == 1);
    CHECK(medium.transmittance(infinity, w)[0] == 0);
    medium.sigma_a = Absorption(0.0f);  // as in a lane where nothing is absorbed
    CHECK(medium.transmittance(infinity, w)[0] == 1);
    CHECK(vacuum.transmittance(infinity, w)[0] == 1);
}
