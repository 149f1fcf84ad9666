// SPDX-License-Identifier: Apache-2.0
#include "colour/monitor.h"

#include <fmt/format.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "base/diagnostics.h"

namespace iride {

namespace {

// Columns x, y, z of the primaries.
MatrixDouble chromaticities(Primaries const& p) {
    MatrixDouble columns;
    for (Chromaticity const& c : {p.red, p.green, p.blue})
        if (!std::isfinite(c.x) || !(c.y > 0) || !std::isfinite(c.y))
            throw InputError({}, "primaries", fmt::format("chromaticity {:g}, {:g}: y must be above 0", c.x, c.y));
    auto const column = [](Chromaticity const& c) { return VectorDouble(c.x, c.y, 1 - c.x - c.y); };
    columns << column(p.red), column(p.green), column(p.blue);
    constexpr double flat = 1e-9;  // twice the area of the triangle in x, y: rounding of primaries on one line
    if (!(std::abs(columns.determinant()) > flat))
        throw InputError({}, "primaries", "they lie on a line and make no white");
    return columns;
}

}  // namespace

MatrixDouble monitor_matrix(Primaries const& primaries, std::array<double, 3> const& luminance) {
    for (double Y : luminance)
        if (!(Y > 0) || !std::isfinite(Y))
            throw InputError({}, "luminance", fmt::format("{:g} of a phosphor: it must be above 0", Y));
    MatrixDouble const columns = chromaticities(primaries);
    VectorDouble const Y(luminance[0], luminance[1], luminance[2]), y = columns.row(1);
    return columns * Y.cwiseQuotient(y).asDiagonal();
}

MatrixDouble monitor_matrix(Primaries const& primaries, Xyz const& white) {
    MatrixDouble const columns = chromaticities(primaries);
    VectorDouble const scale = columns.inverse() * to_vector(white);
    if (!(scale.minCoeff() > 0) || !scale.allFinite())
        throw InputError({}, "white",
                         fmt::format("XYZ {:g} {:g} {:g} lies outside the primaries", white.X, white.Y, white.Z));
    return columns * scale.asDiagonal();
}

MonitorToMonitor::MonitorToMonitor(MatrixDouble const& from, MatrixDouble const& to) : matrix_(to.inverse() * from) {}

Carried MonitorToMonitor::operator()(VectorDouble const& linear_rgb) const {
    constexpr double rounding = 1e-12;  // full drive carried to an equal monitor is not "clipped"
    Carried result{matrix_ * linear_rgb, {}, {}, 0};
    result.rgb = result.unclipped.cwiseMax(0).cwiseMin(1);
    for (int i = 0; i < 3; ++i) {
        double const excess = std::abs(result.unclipped[i] - result.rgb[i]);
        result.clipped[static_cast<std::size_t>(i)] = excess > rounding;
        result.largest_excess = std::max(result.largest_excess, excess);
    }
    return result;
}

}  // namespace iride
