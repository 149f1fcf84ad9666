// SPDX-License-Identifier: Apache-2.0
// Between linear light and the numbers a signal carries: V = encode(L), L = decode(V), V = 1 for the white L = 1.
// Negative values are carried oddly, f(-x) = -f(x), so that colours outside a gamut survive; above 1 the formula goes
// on; NaN stays NaN. decode(encode(L)) = L to 1e-12 relative (the two HDR curves: for L > 1e-9).
#pragma once

namespace iride {

enum class TransferFunction {
    linear,
    // 12.92 L below the break, else 1.055 L^(1/2.4) - .055 [IEC 61966-2-1]. The standard's breaks, L = .0031308 and
    // V = .04045, are roundings that leave a step of -2.8e-8, so that the curve has no inverse there; ours is where the
    // pieces meet, L = .00313067: the difference is below 3e-8, between the two breaks alone.
    srgb,
    // 4.5 L below L = .018, else 1.099 L^.45 - .099 [ITU-R BT.709-6, camera side]. The rounded constants leave a gap in
    // V from .081 to .08125: no L is encoded so, and it decodes to the break.
    rec709,
    // The same with the unrounded constants that BT.2020 states as the solution of "value and slope agree at the
    // break": scale 1.09929682680944, break .018053968510807 [ITU-R BT.2020-2, table 4].
    rec2020,
    adobe_rgb,  // L = V^(563/256) [Adobe RGB (1998)]
    bt1886,     // L = V^2.4: the reference display with black at zero [ITU-R BT.1886]
    // Perceptual quantiser, L = 1 being 10000 cd m^-2 [SMPTE ST 2084] [ITU-R BT.2100]. V(0) = 7.3e-7: the odd extension
    // jumps there, and |V| below it decodes to 0.
    pq,
    // Hybrid log-gamma, camera side: sqrt(3 L) up to L = 1/12, else a ln(12 L - b) + c [ITU-R BT.2100, table 5].
    // V(1) = 1 - 4.9e-9, as its constants give it.
    hlg,
};

double encode(TransferFunction function, double linear);
double decode(TransferFunction function, double encoded);

}  // namespace iride
