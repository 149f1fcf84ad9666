// SPDX-License-Identifier: Apache-2.0
// Chromaticity diagrams of CIE: x, y with luminance; u', v' (1976) and u, v (1960, for correlated colour temperature):
//   u' = 4X / (X + 15Y + 3Z)   v' = 9Y / (X + 15Y + 3Z)   u = u'   v = 2v'/3
// Black has no chromaticity: conversions give it that of the white, so that black goes there and back. [CIE 15:2018, 8]
#pragma once

#include "colour/xyz.h"

namespace iride {

struct Xyy {
    double x, y, Y;
};
struct UvPrime {
    double u, v;
};
struct UvYPrime {
    double u, v, Y;
};
struct Uv1960 {
    double u, v;
};

inline bool is_black(Xyz const& c) { return c.X == 0 && c.Y == 0 && c.Z == 0; }

// u', v' of XYZ; not numbers where X + 15Y + 3Z = 0.
inline UvPrime to_uv_prime(Xyz const& c) {
    double const d = c.X + 15 * c.Y + 3 * c.Z;
    return {4 * c.X / d, 9 * c.Y / d};
}
inline UvPrime to_uv_prime(Chromaticity const& c) {
    double const d = 3 - 2 * c.x + 12 * c.y;
    return {4 * c.x / d, 9 * c.y / d};
}
inline Chromaticity to_chromaticity(UvPrime const& c) {
    double const d = 6 * c.u - 16 * c.v + 12;
    return {9 * c.u / d, 4 * c.v / d};
}
inline Uv1960 to_uv_1960(UvPrime const& c) { return {c.u, c.v * 2 / 3}; }
inline Uv1960 to_uv_1960(Chromaticity const& c) { return to_uv_1960(to_uv_prime(c)); }
inline UvPrime to_uv_prime(Uv1960 const& c) { return {c.u, c.v * 3 / 2}; }
inline Chromaticity to_chromaticity(Uv1960 const& c) { return to_chromaticity(to_uv_prime(c)); }

// XYZ of u', v' and Y: X = 9Yu' / 4v', Z = Y (12 - 3u' - 20v') / 4v'; black where v' = 0 and Y = 0.
inline Xyz to_xyz(UvYPrime const& c) {
    if (c.v == 0 && c.Y == 0) return {};
    return {c.Y * 9 * c.u / (4 * c.v), c.Y, c.Y * (12 - 3 * c.u - 20 * c.v) / (4 * c.v)};
}
inline UvYPrime to_uv_y_prime(Xyz const& c, Xyz const& white) {
    auto const [u, v] = to_uv_prime(is_black(c) ? white : c);
    return {u, v, c.Y};
}

inline Xyy to_xyy(Xyz const& c, Xyz const& white) {
    Chromaticity const xy = to_chromaticity(is_black(c) ? white : c);
    return {xy.x, xy.y, c.Y};
}
inline Xyz to_xyz(Xyy const& c) {
    if (c.y == 0 && c.Y == 0) return {};
    return to_xyz(Chromaticity{c.x, c.y}, c.Y);
}

}  // namespace iride
