// SPDX-License-Identifier: Apache-2.0
// Whether two pictures are the same, bit by bit.
#pragma once

#include "support/scenes.h"

namespace iride::test {

// Means, variances and bands of all pixels.
inline std::vector<double> values_of(Film const& film) {
    std::vector<double> values;
    int const bands = film.bands() ? film.bands()->count : 0;
    for (int y = 0; y < film.height(); ++y)
        for (int x = 0; x < film.width(); ++x) {
            Xyz const m = film.mean(x, y), v = film.variance(x, y);
            values.insert(values.end(), {m.X, m.Y, m.Z, v.X, v.Y, v.Z});
            for (int b = 0; b < bands; ++b) values.push_back(film.band(x, y, b));
        }
    return values;
}

// 8 samples a pixel, in passes of 4, 4 or, doubling, 1, 1, 2, 4.
inline std::vector<double> picture_values(Scene const& scene, std::string const& integrator, int threads,
                                          bool reversed_tiles, bool doubling_passes = false) {
    RenderSettings settings{.spp = 8, .seed = 5, .threads = threads, .reversed_tiles = reversed_tiles};
    if (doubling_passes) settings.stop_at = ErrorTarget::relative(1e-9);  // never reached
    return values_of(rendered(scene, integrator, settings));
}

}  // namespace iride::test
