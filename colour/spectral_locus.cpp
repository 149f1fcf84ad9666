// SPDX-License-Identifier: Apache-2.0
#include "colour/spectral_locus.h"

#include <fmt/format.h>

#include <cmath>

#include "base/diagnostics.h"

namespace iride {

namespace {

// Twice the area of a, b, c: positive if they turn left.
double turn(Chromaticity const& a, Chromaticity const& b, Chromaticity const& c) {
    return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

constexpr Chromaticity middle{1.0 / 3, 1.0 / 3};  // every point of the locus can be seen from it

}  // namespace

// The locus runs clockwise from violet over green to red.
SpectralLocus::SpectralLocus(Observer const& observer) {
    WavelengthRange const domain = observer.ybar.defined_on();
    for (double nm = std::ceil(domain.min_nm); nm <= domain.max_nm; ++nm) {
        Xyz const c = observer.at(nm);
        if (!(c.X + c.Y + c.Z > 0)) continue;
        point_.push_back(to_chromaticity(c));
        nm_.push_back(nm);
        sum_.push_back(c.X + c.Y + c.Z);
    }
    // The ends are the points farthest to the two sides; beyond them the tables' rounding turns the locus back.
    std::size_t first = 0, last = point_.size() - 1;
    while (first < last && turn(middle, point_[first], point_[first + 1]) >= 0) ++first;
    while (first < last && turn(middle, point_[last - 1], point_[last]) >= 0) --last;
    auto const cut = [&](auto& list) {
        list.erase(list.begin() + static_cast<std::ptrdiff_t>(last) + 1, list.end());
        list.erase(list.begin(), list.begin() + static_cast<std::ptrdiff_t>(first));
    };
    cut(point_), cut(nm_), cut(sum_);
}

bool SpectralLocus::contains(Chromaticity const& c) const {
    constexpr double rounding = 1e-12;  // of x, y: a point of the locus itself counts as inside
    double const dx = c.x - middle.x, dy = c.y - middle.y, distance = std::hypot(dx, dy);
    return distance == 0 || distance <= crossing(middle, dx, dy).distance + rounding;  // NaN is outside
}

SpectralLocus::Crossing SpectralLocus::crossing(Chromaticity const& from, double dx, double dy) const {
    double const length = std::hypot(dx, dy);
    Crossing farthest{from, std::nullopt, 0};
    for (std::size_t i = 0; i < point_.size(); ++i) {
        std::size_t const j = (i + 1) % point_.size();
        Chromaticity const &a = point_[i], &b = point_[j];
        // Side of the ray on which a and b lie; it passes between them where the sides differ.
        double const side_a = dx * (a.y - from.y) - dy * (a.x - from.x);
        double const side_b = dx * (b.y - from.y) - dy * (b.x - from.x);
        if (side_a == side_b || side_a * side_b > 0) continue;
        double const t = side_a / (side_a - side_b);
        Chromaticity const at{a.x + t * (b.x - a.x), a.y + t * (b.y - a.y)};
        double const distance = ((at.x - from.x) * dx + (at.y - from.y) * dy) / length;
        if (!(distance > farthest.distance)) continue;
        farthest = {at, std::nullopt, distance};
        // The mixture of both ends with chromaticity weights 1 - t : t has amounts in the inverse ratio of the sums.
        if (j > 0) {
            double const f = t * sum_[i] / (t * sum_[i] + (1 - t) * sum_[j]);
            farthest.wavelength_nm = nm_[i] + f * (nm_[j] - nm_[i]);
        }
    }
    return farthest;
}

DominantWavelength dominant_wavelength(Chromaticity const& colour, Chromaticity const& white,
                                       SpectralLocus const& locus) {
    if (!locus.contains(white))
        throw InputError({}, "white",
                         fmt::format("chromaticity {:g}, {:g} lies outside the spectral locus", white.x, white.y));
    if (!std::isfinite(colour.x) || !std::isfinite(colour.y))
        throw InputError({}, "", "black has no chromaticity and so no dominant wavelength");
    constexpr double same = 1e-9;  // of x, y: what double precision leaves of a white after integration, with margin
    double const dx = colour.x - white.x, dy = colour.y - white.y, distance = std::hypot(dx, dy);
    if (distance <= same) return {std::nullopt, std::nullopt, 0};
    auto const ahead = locus.crossing(white, dx, dy), behind = locus.crossing(white, -dx, -dy);
    return {ahead.wavelength_nm, behind.wavelength_nm, distance / ahead.distance};
}

}  // namespace iride
