// SPDX-License-Identifier: Apache-2.0
// A density on the unit square that is bilinear between its values at the corners, all above 0; for numbers or eight of
// them side by side. [Pharr 2023, A.5.15]
#pragma once

#include <array>

#include "base/trigonometry.h"

namespace iride {

template <class Real>
class BilinearDensity {
  public:
    // of_corner: at (0, 0), (1, 0), (0, 1), (1, 1), up to a common factor.
    explicit BilinearDensity(std::array<Real, 4> const& of_corner) : corner_(of_corner) {}

    struct Sample {
        Real x, y, density;
    };
    Sample sample(Real u, Real v) const {
        auto const [c00, c10, c01, c11] = corner_;
        Real const y = along_line(c00 + c10, c01 + c11, v), low = c00 + y * (c01 - c00), high = c10 + y * (c11 - c10),
                   x = along_line(low, high, u);
        return {x, y, (low + x * (high - low)) * 4.0f / (c00 + c10 + c01 + c11)};
    }

  private:
    // Of density a + t (b - a): the root of (b - a) t^2 + 2 a t = u (a + b), without cancellation.
    static Real along_line(Real a, Real b, Real u) {
        return u * (a + b) / (a + square_root(a * a + u * (b * b - a * a)));
    }

    std::array<Real, 4> corner_;
};

}  // namespace iride
