// SPDX-License-Identifier: Apache-2.0
// Transfer functions: the numbers their standards print, exact inverses, odd extension.
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>

#include "colour/transfer_function.h"

using namespace iride;
using enum TransferFunction;

namespace {

constexpr TransferFunction all[] = {linear, srgb, rec709, rec2020, adobe_rgb, bt1886, pq, hlg};

// Both ends of the range densely, and well above 1.
template <class Visit>
void over_range(double least, Visit visit) {
    for (double x = least; x < 4; x *= 1.01) visit(x);
    for (int i = 0; i <= 4000; ++i) visit(std::max(least, i / 4000.0));
}

}  // namespace

// Fails with the breaks of IEC 61966-2-1 as printed: 2e-9 in L near the break.
TEST_CASE("decode undoes encode to 1e-12", "[law]") {
    for (TransferFunction f : all)
        over_range(f == pq ? 1e-9 : 1e-12, [&](double L) {
            INFO("function " << static_cast<int>(f) << " at " << L);
            REQUIRE(std::abs(decode(f, encode(f, L)) - L) <= 1e-12 * L);
        });
}

TEST_CASE("encode undoes decode to 1e-12, but in the gap of BT.709", "[law]") {
    for (TransferFunction f : all)
        over_range(f == pq ? 1e-2 : 1e-12, [&](double V) {
            if (f == pq && V > 1) return;  // beyond 10000 cd m^-2 the curve soon has a pole
            double const again = encode(f, decode(f, V));
            INFO("function " << static_cast<int>(f) << " at " << V);
            if (f == rec709 && V > .0809999 && V < .08125)
                REQUIRE(std::abs(again - V) < 2.6e-4);
            else
                REQUIRE(std::abs(again - V) <= 1e-12 * V);
        });
}

TEST_CASE("transfer functions are odd, increasing and carry NaN", "[law]") {
    for (TransferFunction f : all) {
        double before = -1;
        over_range(1e-9, [&](double L) { REQUIRE(encode(f, -L) == -encode(f, L)); });
        for (int i = 0; i <= 100000; ++i) {
            double const V = encode(f, i / 100000.0);
            REQUIRE(V > before);
            before = V;
        }
        CHECK(decode(f, -.4) == -decode(f, .4));
        CHECK(std::isnan(encode(f, std::numeric_limits<double>::quiet_NaN())));
        CHECK(std::isnan(decode(f, std::numeric_limits<double>::quiet_NaN())));
        CHECK(decode(f, 0) == 0);
        if (f != pq) CHECK(encode(f, 0) == 0);
    }
}

TEST_CASE("sRGB is IEC 61966-2-1 to 3e-8, and exactly but between the two breaks", "[law]") {
    double most = 0;
    for (double L = 0; L < 1; L += 1e-8 + L * 1e-5) {
        double const printed = L <= .0031308 ? 12.92 * L : 1.055 * std::pow(L, 1 / 2.4) - .055;
        double const difference = std::abs(encode(srgb, L) - printed);
        most = std::max(most, difference);
        if (L < .00313066 || L > .0031308) REQUIRE(difference < 1e-15);
    }
    CHECK(most < 3e-8);
    // Of no 8-bit or 16-bit code does the decoded value depend on which break is taken.
    for (int code = 0; code <= 65535; ++code) {
        double const V = code / 65535.0, printed = V <= .04045 ? V / 12.92 : std::pow((V + .055) / 1.055, 2.4);
        REQUIRE(std::abs(decode(srgb, V) - printed) <= 1e-15);
    }
}

// W3C and IEC: 18 % grey is code 118; the half code is .21404.
TEST_CASE("encoded values are the published ones", "[law]") {
    CHECK(std::lround(255 * encode(srgb, .18)) == 118);
    CHECK(decode(srgb, .5) == Approx(.21404114).margin(1e-8).epsilon(0));
    CHECK(encode(rec709, .18) == Approx(1.099 * std::pow(.18, .45) - .099).margin(1e-15).epsilon(0));
    CHECK(std::abs(encode(rec709, .18) - .409) < 5e-4);  // BT.709: 40.9 % for an 18 % grey
    // BT.2020-2 prints the exact constants: V there is 4.5 beta, reached from both sides.
    double const beta = .018053968510807;
    CHECK(encode(rec2020, beta) == Approx(4.5 * beta).margin(1e-14).epsilon(0));
    CHECK(encode(rec2020, .5) ==
          Approx(1.09929682680944 * std::pow(.5, .45) - .09929682680944).margin(1e-14).epsilon(0));
    CHECK(decode(adobe_rgb, .5) == Approx(std::pow(.5, 2.19921875)).epsilon(1e-15));
    CHECK(decode(bt1886, .5) == Approx(.18946457).margin(1e-8).epsilon(0));
    // BT.2408-7, table 1: PQ and HLG of reference levels, in percent.
    CHECK(encode(pq, 203e-4) == Approx(.58).margin(5e-3).epsilon(0));
    // ST 2084: 100, 1000 and 10000 cd m^-2.
    CHECK(encode(pq, 100e-4) == Approx(.508078).margin(1e-6).epsilon(0));
    CHECK(encode(pq, 1000e-4) == Approx(.751827).margin(1e-6).epsilon(0));
    CHECK(encode(pq, 1) == Approx(1).epsilon(1e-15));
    CHECK(encode(hlg, 1.0 / 12) == Approx(.5).epsilon(1e-15));
    CHECK(encode(hlg, .265) == Approx(.75).margin(5e-4).epsilon(0));  // BT.2408: 203 cd m^-2 of 1000 is 75 %
    CHECK(1 - encode(hlg, 1) == Approx(4.9e-9).margin(1e-10).epsilon(0));
}
