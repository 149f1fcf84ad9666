// SPDX-License-Identifier: Apache-2.0
// The text of data/ocio/config.ocio, with every matrix derived from primaries, whites and CIE definitions.
//   u'v'Y:  log2 of (X/Xn, Y/Yn, D/Dn), D = X + 15Y + 3Z, gives log2 of u'/u'n, v'/v'n and Y by a matrix
//   L*u*v*: L* of Y, then products L* u' and L* v' by logarithms, and a matrix
//   L*a*b*: L* of X/Xn, Y/Yn, Z/Zn, and a matrix
// L* / 100 is OpenColorIO's ExponentWithLinear with gamma 3 and offset .16 reversed: its break is at (6/29)^3, where
// CIE's is. Black has the white's chromaticity. [CIE 15:2018]
#pragma once

#include <string>

namespace iride {

// For OpenColorIO 2.1: built-in transforms, matrices, exponents and logarithms; no LUT files.
std::string shipped_config();

}  // namespace iride
