// SPDX-License-Identifier: Apache-2.0
// Chromatic adaptation: the XYZ that looks under one white as a given XYZ looks under another.
//   XYZ' = M^-1 diag(M w_to / M w_from) M XYZ,   M: XYZ to cone-like responses, w: the whites, Y = 1
// Complete adaptation; the row scale of M cancels.
#pragma once

#include "base/vector.h"
#include "colour/xyz.h"

namespace iride {

enum class Adaptation {
    none,       // the identity: colorimetry alone
    von_kries,  // the cones themselves, Hunt-Pointer-Estevez [Fairchild 2013]
    bradford,   // sharpened cones, linear form [Lam 1985]
    cat02,      // CIECAM02 [Moroney 2002]
    cat16,      // CAM16 [Li 2017]
};

// M of a method; the identity for `none`.
MatrixDouble cone_matrix(Adaptation method);

// From XYZ under white `from` to XYZ under white `to`; exactly the identity when they are equal. Not finite for a white
// with y = 0 or without a response.
MatrixDouble adaptation_matrix(Chromaticity const& from, Chromaticity const& to, Adaptation method);

inline MatrixDouble bradford_adaptation(Chromaticity const& from, Chromaticity const& to) {
    return adaptation_matrix(from, to, Adaptation::bradford);
}

}  // namespace iride
