// SPDX-License-Identifier: Apache-2.0
// Scenes of transparent bodies before an evenly bright wall, and what closed forms say of them.
#pragma once

#include <fmt/format.h>

#include <functional>

#include "colour/observer.h"
#include "support/scenes.h"

namespace iride::test {

// Through what stands at 0 < z < 5, at an angle to z, on a wall of radiance 1. One pencil of rays.
inline std::string through_to_wall(double angle_deg, std::string const& materials, std::string const& shapes,
                                   std::string const& eye = "") {
    double const a = radians(angle_deg);
    std::string const from = eye.empty() ? fmt::format("[{}, 0, {}]", -3 * std::sin(a), -3 * std::cos(a)) : eye;
    return fmt::format(
        R"({{ "camera": {{ "type": "orthographic", "eye": {}, "target": [0,0,0], "window": 1e-3 }},
             "film": {{ "size": [4,4] }}, "render": {{ "sampler": "independent" }},
             "materials": {{ {}, "black": {{ "type": "black" }} }},
             "shapes": [ {}, {{ "type": "quad", "corners": [[-400,-400,5],[-400,400,5],[400,400,5],[400,-400,5]],
                               "material": "black", "emission": {{ "radiance": 1 }} }} ] }})",
        from, materials, shapes);
}
inline std::string wide_box(std::string const& material, double z0, double z1) {
    return fmt::format(R"({{ "type": "box", "min": [-300,-300,{}], "max": [300,300,{}], "material": "{}" }})", z0, z1,
                       material);
}

// X, Y, Z of a spectrum that is given as a function of wavelength.
inline Xyz colour_of(std::function<double(double nm)> const& spectrum) {
    TabulatedShape table;
    for (double nm = visible_range.min_nm; nm <= visible_range.max_nm; ++nm) {
        table.nm.push_back(nm);
        table.value.push_back(spectrum(nm));
    }
    return cie1931_2deg().integrate(SpectralFunction(std::move(table), Outside::zero));
}

// The mean of all pixels and the standard error of its components.
struct Measured {
    Xyz mean, error;
};
inline Measured measured(Film const& film) {
    Xyz sum, variance;
    double const n = film.width() * film.height();
    for (int y = 0; y < film.height(); ++y)
        for (int x = 0; x < film.width(); ++x) {
            sum = sum + film.mean(x, y);
            variance = variance + film.variance(x, y);
        }
    auto const error = [&](double v) { return std::sqrt(v) / n; };
    return {(1 / n) * sum, {error(variance.X), error(variance.Y), error(variance.Z)}};
}

}  // namespace iride::test
