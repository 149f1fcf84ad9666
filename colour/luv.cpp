// SPDX-License-Identifier: Apache-2.0
#include "colour/luv.h"

#include "colour/chromaticity.h"
#include "colour/lab.h"

namespace iride {

Luv to_luv(Xyz const& c, Xyz const& white) {
    double const L = lightness(c.Y / white.Y);
    if (c.X + 15 * c.Y + 3 * c.Z == 0) return {L, 0, 0};
    UvPrime const uv = to_uv_prime(c), n = to_uv_prime(white);
    return {L, 13 * L * (uv.u - n.u), 13 * L * (uv.v - n.v)};
}

Xyz to_xyz(Luv const& c, Xyz const& white) {
    if (c.L == 0) return {};
    UvPrime const n = to_uv_prime(white);
    return to_xyz(UvYPrime{c.u / (13 * c.L) + n.u, c.v / (13 * c.L) + n.v, white.Y * relative_luminance(c.L)});
}

}  // namespace iride
