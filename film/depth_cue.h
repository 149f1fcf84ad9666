// SPDX-License-Identifier: Apache-2.0
// Depth cueing: what is further away fades to a colour. A post filter on a picture that has its depth beside it; the
// light of the scene itself is attenuated by media (materials/medium.h).
//   C' = s C + (1 - s) C_cue,   s = s_front + (s_back - s_front) (z - front) / (back - front)
// between the two depths, s_front before and s_back behind. [Foley 1990, 16.1.3]
#pragma once

#include <array>
#include <filesystem>

namespace iride {

struct DepthCue {
    double front, back;                      // metres; front < back
    double scale_front = 1, scale_back = 0;  // 0 .. 1
    std::array<double, 3> colour{0, 0, 0};   // in the picture's own channels, exposure and all

    // s; depth may be infinite. NaN, no depth at all, counts as behind.
    double share(double depth) const;
};

// Read `in`, write `out`. The channels R G B, or X Y Z, are filtered by depth.Z, depth or Z; the others are kept, but
// not variances and spectral bands, of which a colour says nothing. Throws InputError for files that lack either.
void apply_depth_cue(DepthCue const& cue, std::filesystem::path const& in, std::filesystem::path const& out);

}  // namespace iride
