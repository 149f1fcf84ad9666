// SPDX-License-Identifier: Apache-2.0
// How far the approximations that `iride material --plot` compares are off. Values of exact formulas by independent
// evaluation with complex cosines.
#include "app/fresnel_approximations.h"

#include <catch2/catch.hpp>

#include "base/constants.h"
#include "spectral/catalogue.h"

using namespace iride;

namespace {

// The approximation that is farthest off over the angles, with its sign.
template <class Approximation>
double worst(double n, double k, Approximation const& approximate) {
    double most = 0;
    for (double angle = 0; angle <= 90; angle += .01) {
        double const c = std::cos(radians(angle));
        if (double const d = approximate(c) - fresnel(c, n, k).unpolarised(); std::abs(d) > std::abs(most)) most = d;
    }
    return most;
}
double schlick_error(double n, double k) {
    double const R0 = fresnel(1.0, n, k).unpolarised();
    return worst(n, k, [&](double c) { return schlick(c, R0); });
}
double fast_error(double n, double k) {
    return worst(n, k, [&](double c) { return fast_conductor(c, n, k).unpolarised(); });
}

}  // namespace

TEST_CASE("Schlick's formula is up to .186 too bright on aluminium in the visible", "[law]") {
    ComplexIndex const aluminium = load_complex_index("Al");
    double most = 0;
    for (double nm = 380; nm <= 780; nm += 10)
        most = std::max(most, schlick_error(aluminium.n.at(nm), aluminium.k.at(nm)));
    CHECK(most == Approx(.186).margin(.001));
}

TEST_CASE("the fast conductor formula is off by what is known of it", "[law]") {
    CHECK(std::abs(fast_error(.2, 3)) == Approx(3.30e-3).epsilon(.005));
    CHECK(std::abs(fast_error(.143, 3.983)) == Approx(1.51e-3).epsilon(.005));
    CHECK(std::abs(fast_error(1.1, 6.7)) == Approx(2.36e-3).epsilon(.005));
    CHECK(std::abs(fast_error(2.9, 3)) == Approx(5.14e-3).epsilon(.005));
    CHECK(std::abs(fast_error(1.5, .5)) == Approx(5.16e-2).epsilon(.005));
    CHECK(fast_conductor(.5, .2, 3).unpolarised() == Approx(.92112172).margin(5e-9));
    CHECK(fast_conductor(.5, 1.5, 0).unpolarised() == Approx(.13520408).margin(5e-9));  // exact: .08918671
}

// n = (1 + sqrt(R0)) / (1 - sqrt(R0)): 78 for R0 = .95, though no metal has such an index.
TEST_CASE("the index of 1982 gives the normal reflectance back and misses the rest", "[law]") {
    for (double R0 : {.02, .04, .5, .95})
        CHECK(fresnel(1.0, index_of_reflectance(R0), 0.0).unpolarised() == Approx(R0).epsilon(1e-12));
    CHECK(index_of_reflectance(.95) == Approx(78).margin(.1));
    CHECK(index_of_reflectance(.04) == Approx(1.5).epsilon(1e-12));
    CHECK(colour_shift_1982(1, .8) == Approx(0).margin(1e-12));
    CHECK(colour_shift_1982(0, .8) == Approx(1).epsilon(1e-12));
    CHECK(colour_shift_1982(std::cos(radians(60)), .8) == 0);  // the real index darkens first: no shift at all
}
