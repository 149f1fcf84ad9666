// SPDX-License-Identifier: Apache-2.0
#include "film/compare.h"

#include <fmt/format.h>

#include <cmath>

#include "base/diagnostics.h"
#include "colour/difference.h"

namespace iride {

Comparison compare(XyzPicture const& a, XyzPicture const& b) {
    if (a.xyz.width != b.xyz.width || a.xyz.height != b.xyz.height)
        throw InputError({}, "",
                         fmt::format("the pictures differ in size: {} x {} and {} x {}", a.xyz.width, a.xyz.height,
                                     b.xyz.width, b.xyz.height));
    Comparison result{a.xyz.width, a.xyz.height, 0, 0, 0, 0, 0};
    Xyz const white = to_xyz(named_white("D65"), 1);
    for (std::size_t i = 0; i < a.xyz.pixel.size(); ++i) {
        Xyz const &p = a.xyz.pixel[i], &q = b.xyz.pixel[i];
        for (double Xyz::*c : {&Xyz::X, &Xyz::Y, &Xyz::Z}) {
            double const d2 = square(p.*c - q.*c);
            result.mse += d2;
            result.relmse += d2 / (square(q.*c) + relmse_floor);
        }
        double const de = delta_e_2000(to_lab(p, white), to_lab(q, white));
        result.delta_e_2000_mean += de;
        result.delta_e_2000_max = std::max(result.delta_e_2000_max, de);
    }
    auto const count = static_cast<double>(a.xyz.pixel.size());
    result.mse /= 3 * count;
    result.relmse /= 3 * count;
    result.rmse = std::sqrt(result.mse);
    result.delta_e_2000_mean /= count;
    return result;
}

}  // namespace iride
