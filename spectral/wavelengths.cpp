// SPDX-License-Identifier: Apache-2.0
#include "spectral/wavelengths.h"

#include <algorithm>
#include <cmath>

namespace iride {

WavelengthGrid WavelengthGrid::covering(WavelengthRange const& range) {
    int const first = static_cast<int>(std::floor(range.min_nm)), last = static_cast<int>(std::ceil(range.max_nm));
    return {first, std::max(2, last - first + 1)};
}

WavelengthSampler::WavelengthSampler(WavelengthRange const& range, SpectralFunction const& importance,
                                     WavelengthGrid const& grid)
    : range_(range), grid_first_nm_(grid.first_nm), grid_cells_(grid.count - 1) {
    // Cumulative of the floored importance by the midpoint rule, then its inverse at equal steps.
    constexpr int steps = 8192;
    constexpr double floor_share = 1e-3;  // of the mean: the least density, relative to a uniform one
    double const dx = range.width() / steps, mean = importance.integral(range) / range.width();
    std::vector<double> cumulative{0};
    for (int i = 0; i < steps; ++i) {
        double const wanted = mean > 0 ? importance.at(range.min_nm + (i + 0.5) * dx) / mean : 1;
        cumulative.push_back(cumulative.back() + std::max(wanted, floor_share));
    }
    std::vector<double> knots;
    std::size_t at = 0;
    for (int k = 0; k <= segment_count; ++k) {
        double const target = cumulative.back() * k / segment_count;
        while (at + 2 < cumulative.size() && cumulative[at + 1] < target) ++at;
        double const f = (target - cumulative[at]) / (cumulative[at + 1] - cumulative[at]);
        knots.push_back(range.min_nm + (static_cast<double>(at) + f) * dx);
        knot_nm_.push_back(static_cast<float>(knots.back()));
    }
    for (std::size_t k = 0; k < segment_count; ++k)
        density_.push_back(static_cast<float>(1 / (segment_count * (knots[k + 1] - knots[k]))));
    knot_nm_.front() = static_cast<float>(range.min_nm);
    knot_nm_.back() = static_cast<float>(range.max_nm);
}

namespace {

void place_on_grid(Wavelengths& w, int first_nm, int cells) {
    LaneRegister const on_grid = w.nm - static_cast<float>(first_nm);
    LaneIndex const cell = __builtin_convertvector(on_grid, LaneIndex), last = LaneIndex{} + (cells - 1);
    w.cell = cell < last ? cell : last;
    w.fraction = on_grid - __builtin_convertvector(w.cell, LaneRegister);
}

}  // namespace

Wavelengths wavelengths_at(LaneRegister const& nm, WavelengthGrid const& grid) {
    Wavelengths w;
    w.nm = nm;
    w.density = Sampled<dim::per_nanometre>(1.0f);
    place_on_grid(w, grid.first_nm, grid.count - 1);
    return w;
}

Wavelengths WavelengthSampler::sample(float u) const {
    static_assert(segment_count % lane_count == 0 && (segment_count & (segment_count - 1)) == 0);
    float const scaled = u * segment_count;
    int const hero_segment = std::min(static_cast<int>(scaled), segment_count - 1);
    float const f = scaled - static_cast<float>(hero_segment);
    LaneIndex segment;
    for (int i = 0; i < lane_count; ++i)
        segment[i] = (hero_segment + i * (segment_count / lane_count)) & (segment_count - 1);
    auto const [low, high] = ends_of_cells(knot_nm_.data(), segment);
    Wavelengths w;
    w.nm = low + f * (high - low);
    for (int i = 0; i < lane_count; ++i) w.density.lane[i] = density_[static_cast<std::size_t>(segment[i])];
    place_on_grid(w, grid_first_nm_, grid_cells_);
    return w;
}

SpectralFunction visible_importance() {
    // Two bumps 1 / cosh^2, chosen by search so that both eight lanes and a lone one (after a dispersive refraction)
    // vary little. Standard deviation of (X, Y, Z) of white D65 per path, quadrature over the rotation:
    //   8 lanes (.0057, .0019, .0118), 1 lane (.80, .83, 1.64).  A single bump 1 / cosh^2((nm - 538) / 138.9) has
    //   8 lanes (.0193, .0055, .0689), 1 lane (.85, .93, 2.13).
    TabulatedShape table;
    for (double nm = visible_range.min_nm; nm <= visible_range.max_nm; ++nm) {
        auto const bump = [&](double centre, double scale) { return std::pow(std::cosh((nm - centre) / scale), -2); };
        table.nm.push_back(nm);
        table.value.push_back(0.7 * bump(440, 32) + bump(550, 90));
    }
    return SpectralFunction(std::move(table), Outside::hold, "visible importance");
}

}  // namespace iride
