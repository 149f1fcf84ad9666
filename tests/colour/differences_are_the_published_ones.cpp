// SPDX-License-Identifier: Apache-2.0
// CIEDE2000 on the 34 pairs of [Sharma 2005, table 1]; the others on figures of an independent implementation.
#include <catch2/catch.hpp>

#include "base/diagnostics.h"
#include "colour/difference.h"
#include "support/sharma.h"

using namespace iride;

namespace {

Lab const standard{100, 21.57210357, 272.22819350};
Lab const samples[] = {
    {100, 426.67945353, 72.39590835}, {100, 74.05216981, 276.45318193}, {100, 8.32281957, -73.58297716}};

void check_three(char const* formula, double a, double b, double c) {
    double const wanted[] = {a, b, c};
    for (int i = 0; i < 3; ++i) {
        INFO(formula << " " << i);
        CHECK(difference_formula(formula).of(standard, samples[i]) == Approx(wanted[i]).margin(1e-7).epsilon(0));
    }
}

}  // namespace

// Pairs 9 to 15 catch a mean hue on the wrong side of the circle, 1 to 6 a wrong sign of the rotation term.
TEST_CASE("CIEDE2000 is right on all 34 pairs of Sharma, Wu and Dalal", "[law]") {
    static_assert(std::size(test::sharma_pairs) == 34);
    for (test::LabPair const& pair : test::sharma_pairs) {
        INFO(pair.p.a << " " << pair.p.b << ", " << pair.q.a << " " << pair.q.b);
        CHECK(delta_e_2000(pair.p, pair.q) == Approx(pair.difference).margin(5.1e-5).epsilon(0));
        CHECK(delta_e_2000(pair.q, pair.p) == Approx(delta_e_2000(pair.p, pair.q)).margin(1e-12));
    }
}

TEST_CASE("the other formulas agree with an independent implementation", "[law]") {
    check_three("cie1994", 83.779225500887094, 10.053931954553839, 57.535453706667425);
    check_three("cie1994-textiles", 88.335553057506502, 10.612657890048272, 60.368687261063329);
    check_three("cmc", 172.70477129, 20.59732717, 121.71841479);
    // The third has hues 85.5 and 276.4 degrees: their mean is 0.96 [Sharma 2005, eq. 14]; 360.96 would give 68.230949.
    check_three("cie2000", 94.03564903, 14.87906419, 68.2311125106);
    CHECK(delta_e_1976({50, 1, 2}, {53, 5, 14}) == Approx(13).epsilon(1e-15));
}

TEST_CASE("lightness alone counts as each formula weighs it", "[law]") {
    Lab const p{50, 0, 0}, q{54, 0, 0};
    CHECK(delta_e_1994(p, q, graphic_arts) == Approx(4).epsilon(1e-14));
    CHECK(delta_e_1994(p, q, textiles) == Approx(2).epsilon(1e-14));
    double const SL = .040975 * 50 / (1 + .01765 * 50);
    CHECK(delta_e_cmc(p, q, 2, 1) == Approx(2 / SL).epsilon(1e-14));
    CHECK(delta_e_cmc(p, q, 1, 1) == Approx(4 / SL).epsilon(1e-14));
    CHECK(delta_e_cmc({15, 0, 0}, {16, 0, 0}, 1, 1) == Approx(1 / .511).epsilon(1e-13));
}

TEST_CASE("an unknown difference formula is refused with its nearest", "[input]") {
    CHECK_THROWS_WITH(difference_formula("cie200"), Catch::Contains("did you mean 'cie2000'"));
}
