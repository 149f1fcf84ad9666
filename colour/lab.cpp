// SPDX-License-Identifier: Apache-2.0
#include "colour/lab.h"

#include <cmath>

namespace iride {

namespace {

constexpr double knee = 6.0 / 29;                // f at the joint of cube root and tangent line
constexpr double offset = 4.0 / 29;              // f(0)
constexpr double slope = 1 / (3 * knee * knee);  // of the tangent line

// f(t) - f(0): the offset cancels in L*, a*, b*, and without it small values keep all their digits.
double companded(double t) { return t > knee * knee * knee ? std::cbrt(t) - offset : slope * t; }

double expanded(double g) {
    double const f = g + offset;
    return f > knee ? f * f * f : g / slope;
}

}  // namespace

double lightness(double t) { return 116 * companded(t); }
double relative_luminance(double L) { return expanded(L / 116); }

Lab to_lab(Xyz const& c, Xyz const& white) {
    double const x = companded(c.X / white.X), y = companded(c.Y / white.Y), z = companded(c.Z / white.Z);
    return {116 * y, 500 * (x - y), 200 * (y - z)};
}

Xyz to_xyz(Lab const& c, Xyz const& white) {
    double const y = c.L / 116;
    return {white.X * expanded(y + c.a / 500), white.Y * expanded(y), white.Z * expanded(y - c.b / 200)};
}

}  // namespace iride
