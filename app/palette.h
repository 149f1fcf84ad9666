// SPDX-License-Identifier: Apache-2.0
// Dark, distinguishable colours for lines, after Okabe and Ito's palette for all kinds of colour vision.
#pragma once

#include "app/plot.h"

namespace iride {

inline constexpr std::array<PlotColour, 8> line_palette{{{0, 0, 0},
                                                         {0, .45, .70},
                                                         {.84, .37, 0},
                                                         {0, .62, .45},
                                                         {.80, .47, .65},
                                                         {.90, .62, 0},
                                                         {.34, .71, .91},
                                                         {.6, .6, .6}}};

}  // namespace iride
