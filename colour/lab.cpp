// SPDX-License-Identifier: Apache-2.0
#include "colour/lab.h"

#include <algorithm>
#include <cmath>

#include "base/vector.h"

namespace iride {

namespace {

double companded(double t) {
    constexpr double knee = 6.0 / 29;
    return t > knee * knee * knee ? std::cbrt(t) : t / (3 * knee * knee) + 4.0 / 29;
}

// Hue angle in degrees, 0 .. 360; 0 for a neutral.
double hue_deg(double a, double b) {
    if (a == 0 && b == 0) return 0;
    double const h = std::atan2(b, a) / radians(1);
    return h < 0 ? h + 360 : h;
}

double cos_deg(double degrees) { return std::cos(radians(degrees)); }
double seventh_power_ratio(double chroma) {
    constexpr double c25 = 6103515625.0;  // 25^7
    double const c7 = std::pow(chroma, 7);
    return std::sqrt(c7 / (c7 + c25));
}

}  // namespace

Lab to_lab(Xyz const& c, Xyz const& white) {
    double const x = companded(c.X / white.X), y = companded(c.Y / white.Y), z = companded(c.Z / white.Z);
    return {116 * y - 16, 500 * (x - y), 200 * (y - z)};
}

double delta_e_2000(Lab const& p, Lab const& q) {
    double const g = 0.5 * (1 - seventh_power_ratio((std::hypot(p.a, p.b) + std::hypot(q.a, q.b)) / 2));
    double const a1 = (1 + g) * p.a, a2 = (1 + g) * q.a;
    double const C1 = std::hypot(a1, p.b), C2 = std::hypot(a2, q.b);
    double const h1 = hue_deg(a1, p.b), h2 = hue_deg(a2, q.b);
    bool const neutral = C1 * C2 == 0;
    double dh = neutral ? 0 : h2 - h1;
    if (dh > 180) dh -= 360;
    if (dh < -180) dh += 360;
    double const dL = q.L - p.L, dC = C2 - C1, dH = 2 * std::sqrt(C1 * C2) * std::sin(radians(dh / 2));
    double const L = (p.L + q.L) / 2, C = (C1 + C2) / 2;
    double h = neutral ? h1 + h2 : (h1 + h2) / 2;
    if (!neutral && std::abs(h1 - h2) > 180) h += h1 + h2 < 360 ? 180 : -180;
    double const T =
        1 - 0.17 * cos_deg(h - 30) + 0.24 * cos_deg(2 * h) + 0.32 * cos_deg(3 * h + 6) - 0.20 * cos_deg(4 * h - 63);
    double const SL = 1 + 0.015 * square(L - 50) / std::sqrt(20 + square(L - 50));
    double const SC = 1 + 0.045 * C, SH = 1 + 0.015 * C * T;
    double const turn = 30 * std::exp(-square((h - 275) / 25));
    double const RT = -2 * seventh_power_ratio(C) * std::sin(radians(2 * turn));
    double const l = dL / SL, c = dC / SC, s = dH / SH;
    return std::sqrt(std::max(0.0, l * l + c * c + s * s + RT * c * s));
}

}  // namespace iride
