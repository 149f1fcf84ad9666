// SPDX-License-Identifier: Apache-2.0
// A monitor as three lights: the matrix from its linear RGB to XYZ, in two ways, and from one monitor to another,
//   J = (columns x, y, z of the primaries) diag(Y_i / y_i)   or   scaled so that J (1,1,1) is the white,
//   RGB_2 = J_2^-1 J_1 RGB_1. [SMPTE RP 177:1993]
#pragma once

#include <array>

#include "base/vector.h"
#include "colour/xyz.h"

namespace iride {

struct Primaries {
    Chromaticity red, green, blue;
};

// From the luminances of the three phosphors at full drive, in any unit: Y of white is their sum.
MatrixDouble monitor_matrix(Primaries const& primaries, std::array<double, 3> const& luminance);
// From the white's XYZ at full drive. Both throw InputError: y <= 0, primaries on a line, a luminance or a share of the
// white that is not above 0.
MatrixDouble monitor_matrix(Primaries const& primaries, Xyz const& white);

// A colour carried to another monitor. What it cannot show is clipped, and says by how much.
struct Carried {
    VectorDouble unclipped, rgb;  // linear; rgb within 0 .. 1
    std::array<bool, 3> clipped;  // per channel
    double largest_excess;        // farthest distance of a channel from 0 .. 1
};
class MonitorToMonitor {
  public:
    MonitorToMonitor(MatrixDouble const& from, MatrixDouble const& to);

    MatrixDouble const& matrix() const { return matrix_; }  // J_2^-1 J_1
    Carried operator()(VectorDouble const& linear_rgb) const;

  private:
    MatrixDouble matrix_;
};

}  // namespace iride
