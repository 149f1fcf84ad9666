// SPDX-License-Identifier: Apache-2.0
// CIE 1976 L*u*v*, there and back: u* = 13 L* (u' - u'n), v* = 13 L* (v' - v'n), with L* of lab.h. [ISO/CIE 11664-5]
#pragma once

#include "colour/xyz.h"

namespace iride {

struct Luv {
    double L, u, v;
};

// A colour with X + 15Y + 3Z = 0 has no u', v'; it is given the white's. L* = 0 is black whatever u* and v* say: X and
// Z of a colour without luminance cannot be told in this space.
Luv to_luv(Xyz const& colour, Xyz const& white);
Xyz to_xyz(Luv const& colour, Xyz const& white);

}  // namespace iride
