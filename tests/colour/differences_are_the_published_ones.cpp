// SPDX-License-Identifier: Apache-2.0
// CIEDE2000 on the 34 pairs of [Sharma 2005, table 1]; the others on figures of an independent implementation.
#include <catch2/catch.hpp>

#include "base/diagnostics.h"
#include "colour/difference.h"

using namespace iride;

namespace {

struct Pair {
    Lab p, q;
    double difference;
};

Pair const sharma[] = {
    {{50.0000, 2.6772, -79.7751}, {50.0000, 0.0000, -82.7485}, 2.0425},
    {{50.0000, 3.1571, -77.2803}, {50.0000, 0.0000, -82.7485}, 2.8615},
    {{50.0000, 2.8361, -74.0200}, {50.0000, 0.0000, -82.7485}, 3.4412},
    {{50.0000, -1.3802, -84.2814}, {50.0000, 0.0000, -82.7485}, 1.0000},
    {{50.0000, -1.1848, -84.8006}, {50.0000, 0.0000, -82.7485}, 1.0000},
    {{50.0000, -0.9009, -85.5211}, {50.0000, 0.0000, -82.7485}, 1.0000},
    {{50.0000, 0.0000, 0.0000}, {50.0000, -1.0000, 2.0000}, 2.3669},
    {{50.0000, -1.0000, 2.0000}, {50.0000, 0.0000, 0.0000}, 2.3669},
    {{50.0000, 2.4900, -0.0010}, {50.0000, -2.4900, 0.0009}, 7.1792},
    {{50.0000, 2.4900, -0.0010}, {50.0000, -2.4900, 0.0010}, 7.1792},
    {{50.0000, 2.4900, -0.0010}, {50.0000, -2.4900, 0.0011}, 7.2195},
    {{50.0000, 2.4900, -0.0010}, {50.0000, -2.4900, 0.0012}, 7.2195},
    {{50.0000, -0.0010, 2.4900}, {50.0000, 0.0009, -2.4900}, 4.8045},
    {{50.0000, -0.0010, 2.4900}, {50.0000, 0.0010, -2.4900}, 4.8045},
    {{50.0000, -0.0010, 2.4900}, {50.0000, 0.0011, -2.4900}, 4.7461},
    {{50.0000, 2.5000, 0.0000}, {50.0000, 0.0000, -2.5000}, 4.3065},
    {{50.0000, 2.5000, 0.0000}, {73.0000, 25.0000, -18.0000}, 27.1492},
    {{50.0000, 2.5000, 0.0000}, {61.0000, -5.0000, 29.0000}, 22.8977},
    {{50.0000, 2.5000, 0.0000}, {56.0000, -27.0000, -3.0000}, 31.9030},
    {{50.0000, 2.5000, 0.0000}, {58.0000, 24.0000, 15.0000}, 19.4535},
    {{50.0000, 2.5000, 0.0000}, {50.0000, 3.1736, 0.5854}, 1.0000},
    {{50.0000, 2.5000, 0.0000}, {50.0000, 3.2972, 0.0000}, 1.0000},
    {{50.0000, 2.5000, 0.0000}, {50.0000, 1.8634, 0.5757}, 1.0000},
    {{50.0000, 2.5000, 0.0000}, {50.0000, 3.2592, 0.3350}, 1.0000},
    {{60.2574, -34.0099, 36.2677}, {60.4626, -34.1751, 39.4387}, 1.2644},
    {{63.0109, -31.0961, -5.8663}, {62.8187, -29.7946, -4.0864}, 1.2630},
    {{61.2901, 3.7196, -5.3901}, {61.4292, 2.2480, -4.9620}, 1.8731},
    {{35.0831, -44.1164, 3.7933}, {35.0232, -40.0716, 1.5901}, 1.8645},
    {{22.7233, 20.0904, -46.6940}, {23.0331, 14.9730, -42.5619}, 2.0373},
    {{36.4612, 47.8580, 18.3852}, {36.2715, 50.5065, 21.2231}, 1.4146},
    {{90.8027, -2.0831, 1.4410}, {91.1528, -1.6435, 0.0447}, 1.4441},
    {{90.9257, -0.5406, -0.9208}, {88.6381, -0.8985, -0.7239}, 1.5381},
    {{6.7747, -0.2908, -2.4247}, {5.8714, -0.0985, -2.2286}, 0.6377},
    {{2.0776, 0.0795, -1.1350}, {0.9033, -0.0636, -0.5514}, 0.9082},
};

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
    static_assert(std::size(sharma) == 34);
    for (Pair const& pair : sharma) {
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
