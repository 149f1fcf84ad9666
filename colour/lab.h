// SPDX-License-Identifier: Apache-2.0
// CIE 1976 L*a*b* and the CIEDE2000 colour difference.
#pragma once

#include "colour/xyz.h"

namespace iride {

struct Lab {
    double L, a, b;
};

// L* = 116 f(Y/Yn) - 16, a* = 500 (f(X/Xn) - f(Y/Yn)), b* = 200 (f(Y/Yn) - f(Z/Zn)); f(t) = cbrt(t) above (6/29)^3,
// else the tangent line, which also carries negative values. [ISO/CIE 11664-4]
Lab to_lab(Xyz const& colour, Xyz const& white);

// CIEDE2000 with kL = kC = kH = 1. [ISO/CIE 11664-6] [Sharma 2005]
double delta_e_2000(Lab const& a, Lab const& b);

}  // namespace iride
