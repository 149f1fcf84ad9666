// SPDX-License-Identifier: Apache-2.0
#include "colour/lch.h"

#include <cmath>

#include "base/vector.h"

namespace iride {

double hue_deg(double a, double b) {
    if (a == 0 && b == 0) return 0;
    double const h = std::atan2(b, a) / radians(1);
    double const turned = h < 0 ? h + 360 : h;
    return turned < 360 ? turned : 0;  // a tiny negative angle rounds up to the full turn
}

LchUv to_lch(Luv const& c) { return {c.L, std::hypot(c.u, c.v), hue_deg(c.u, c.v)}; }
LchAb to_lch(Lab const& c) { return {c.L, std::hypot(c.a, c.b), hue_deg(c.a, c.b)}; }
Luv to_luv(LchUv const& c) { return {c.L, c.C * std::cos(radians(c.h_deg)), c.C * std::sin(radians(c.h_deg))}; }
Lab to_lab(LchAb const& c) { return {c.L, c.C * std::cos(radians(c.h_deg)), c.C * std::sin(radians(c.h_deg))}; }

}  // namespace iride
