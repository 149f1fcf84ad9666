// SPDX-License-Identifier: Apache-2.0
// CIE 1976 L*a*b*, there and back. [ISO/CIE 11664-4]
#pragma once

#include "colour/xyz.h"

namespace iride {

struct Lab {
    double L, a, b;
};

// L* = 116 f(Y/Yn) - 16, a* = 500 (f(X/Xn) - f(Y/Yn)), b* = 200 (f(Y/Yn) - f(Z/Zn)); f(t) = cbrt(t) above (6/29)^3,
// else the tangent line, which also carries negative values.
Lab to_lab(Xyz const& colour, Xyz const& white);
Xyz to_xyz(Lab const& colour, Xyz const& white);

// L* of Y/Yn, and back: the lightness of L*a*b* and L*u*v*.
double lightness(double relative_luminance);
double relative_luminance(double lightness);

}  // namespace iride
