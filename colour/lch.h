// SPDX-License-Identifier: Apache-2.0
// Lightness, chroma and hue: the cylindrical form of L*u*v* and L*a*b*, C = hypot, h = atan2 in degrees, 0 .. 360.
// [ISO/CIE 11664-4] [ISO/CIE 11664-5]
#pragma once

#include "colour/lab.h"
#include "colour/luv.h"

namespace iride {

// Hue angle of the point (a, b) [degrees], 0 <= h < 360; 0 for a neutral.
double hue_deg(double a, double b);

struct LchUv {
    double L, C, h_deg;
};
struct LchAb {
    double L, C, h_deg;
};

LchUv to_lch(Luv const& c);
LchAb to_lch(Lab const& c);
Luv to_luv(LchUv const& c);
Lab to_lab(LchAb const& c);

}  // namespace iride
