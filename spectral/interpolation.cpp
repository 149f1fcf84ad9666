// SPDX-License-Identifier: Apache-2.0
#include "spectral/interpolation.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/diagnostics.h"

namespace iride {

namespace {

// Two values beyond the start of a table, such that the polynomials go on smoothly; `a` are the first six values in the
// order away from the end. [CIE 167:2005, table V]
std::array<double, 2> beyond_end(std::array<double, 6> const& a) {
    return {(508 * a[0] - 540 * a[1] + 488 * a[2] - 367 * a[3] + 144 * a[4] - 24 * a[5]) / 209,
            (884 * a[0] - 1960 * a[1] + 3033 * a[2] - 2648 * a[3] + 1080 * a[4] - 180 * a[5]) / 209};
}

// Sprague's polynomial between r[2] and r[3]; x in 0 .. 1.
double sprague(double const* r, double x) {
    double const a1 = (2 * r[0] - 16 * r[1] + 16 * r[3] - 2 * r[4]) / 24,
                 a2 = (-r[0] + 16 * r[1] - 30 * r[2] + 16 * r[3] - r[4]) / 24,
                 a3 = (-9 * r[0] + 39 * r[1] - 70 * r[2] + 66 * r[3] - 33 * r[4] + 7 * r[5]) / 24,
                 a4 = (13 * r[0] - 64 * r[1] + 126 * r[2] - 124 * r[3] + 61 * r[4] - 12 * r[5]) / 24,
                 a5 = (-5 * r[0] + 25 * r[1] - 50 * r[2] + 50 * r[3] - 25 * r[4] + 5 * r[5]) / 24;
    return r[2] + x * (a1 + x * (a2 + x * (a3 + x * (a4 + x * a5))));
}

}  // namespace

double equal_step(std::vector<double> const& nm) {
    if (nm.size() < 2) return 0;
    constexpr double tolerance = 1e-3;  // of a step: tables give wavelengths to a few digits
    double const step = (nm.back() - nm.front()) / static_cast<double>(nm.size() - 1);
    for (std::size_t i = 0; i < nm.size(); ++i)
        if (std::abs(nm[i] - nm.front() - step * static_cast<double>(i)) > tolerance * step) return 0;
    return step;
}

SpectralFunction sprague_interpolated(SpectralFunction const& table) {
    auto const* t = std::get_if<TabulatedShape>(&table.shape());
    double const step = t && !t->step ? equal_step(t->nm) : 0;
    if (step == 0 || t->nm.size() < 6)
        throw InputError({}, "",
                         fmt::format("'{}' is no table of six or more equally spaced wavelengths, as Sprague's "
                                     "interpolation wants it",
                                     table.name()));
    std::vector<double> values;
    for (double nm : t->nm) values.push_back(table.at(nm));
    std::array<double, 6> first, last;
    std::copy_n(values.begin(), 6, first.begin());
    std::copy_n(values.rbegin(), 6, last.begin());
    auto const before = beyond_end(first), after = beyond_end(last);
    values.insert(values.begin(), {before[1], before[0]});
    values.insert(values.end(), {after[0], after[1]});
    TabulatedShape fine;
    auto const intervals = static_cast<std::ptrdiff_t>(t->nm.size()) - 1;
    for (double nm = std::ceil(t->nm.front()); nm <= t->nm.back(); ++nm) {
        double const place = (nm - t->nm.front()) / step;
        auto const cell = std::clamp<std::ptrdiff_t>(static_cast<std::ptrdiff_t>(place), 0, intervals - 1);
        fine.nm.push_back(nm);
        fine.value.push_back(sprague(values.data() + cell, place - static_cast<double>(cell)));
    }
    return SpectralFunction(std::move(fine), table.outside(), table.name());
}

std::array<double, 3> lagrange_quadratic(double x) { return {(x - 1) * (x - 2) / 2, -x * (x - 2), x * (x - 1) / 2}; }

std::array<double, 4> lagrange_cubic(double x) {
    return {-(x - 1) * (x - 2) * (x - 3) / 6, x * (x - 2) * (x - 3) / 2, -x * (x - 1) * (x - 3) / 2,
            x * (x - 1) * (x - 2) / 6};
}

}  // namespace iride
