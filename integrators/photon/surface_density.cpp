// SPDX-License-Identifier: Apache-2.0
#include "integrators/photon/surface_density.h"

#include <algorithm>
#include <array>

#include "integrators/photon/disc_area.h"

namespace iride {

HistogramDensity::HistogramDensity(std::vector<Vector2> const& points, int side)
    : side_(side), density_(static_cast<std::size_t>(side * side), 0.0) {
    double const each = static_cast<double>(side) * side / static_cast<double>(points.size());
    for (Vector2 const& p : points) density_[static_cast<std::size_t>(cell(p.y()) * side + cell(p.x()))] += each;
}
int HistogramDensity::cell(float u) const {
    return std::clamp(static_cast<int>(u * static_cast<float>(side_)), 0, side_ - 1);
}
double HistogramDensity::at(Vector2 const& uv) const {
    return density_[static_cast<std::size_t>(cell(uv.y()) * side_ + cell(uv.x()))];
}

SeriesDensity::SeriesDensity(std::vector<Vector2> const& points, int side, SeriesBasis basis)
    : side_(side), basis_(basis), coefficient_(static_cast<std::size_t>(side * side), 0.0) {
    auto const n = static_cast<std::size_t>(side);
    std::vector<double> along_u(n), along_v(n);
    for (Vector2 const& p : points) {
        values(static_cast<double>(p.x()), along_u);
        values(static_cast<double>(p.y()), along_v);
        for (std::size_t i = 0; i < n; ++i)
            for (std::size_t j = 0; j < n; ++j) coefficient_[i * n + j] += along_u[i] * along_v[j];
    }
    for (double& c : coefficient_) c /= static_cast<double>(points.size());
}
void SeriesDensity::values(double u, std::vector<double>& into) const {
    auto const n = static_cast<std::size_t>(side_);
    if (basis_ == SeriesBasis::cosine) {
        for (std::size_t i = 0; i < n; ++i)
            into[i] = i == 0 ? 1 : std::sqrt(2.0) * std::cos(pi_double * static_cast<double>(i) * u);
        return;
    }
    // (i + 1) P_{i+1} = (2 i + 1) x P_i - i P_{i-1}; the norm on [0, 1] is 1 / sqrt(2 i + 1).
    double const x = 2 * u - 1;
    double before = 0, here = 1;
    for (std::size_t i = 0; i < n; ++i) {
        auto const k = static_cast<double>(i);
        into[i] = here * std::sqrt(2 * k + 1);
        double const next = ((2 * k + 1) * x * here - k * before) / (k + 1);
        before = here;
        here = next;
    }
}
double SeriesDensity::at(Vector2 const& uv) const {
    auto const n = static_cast<std::size_t>(side_);
    std::vector<double> along_u(n), along_v(n);
    values(static_cast<double>(uv.x()), along_u);
    values(static_cast<double>(uv.y()), along_v);
    double sum = 0;
    for (std::size_t i = 0; i < n; ++i)
        for (std::size_t j = 0; j < n; ++j) sum += coefficient_[i * n + j] * along_u[i] * along_v[j];
    return sum;
}

NeighbourDensity::NeighbourDensity(std::vector<Vector2> const& points, int k, bool clipped)
    : k_(std::min(static_cast<std::size_t>(k), points.size())), clipped_(clipped) {
    std::vector<PhotonGrid::Entry> entries;
    for (Vector2 const& p : points) entries.push_back({{p.x(), p.y(), 0}, 0});
    // As wide as the disc of k points would be, were they even.
    float const cell = std::sqrt(static_cast<float>(k_) / (pi * static_cast<float>(points.size())));
    points_ = PhotonGrid(entries, cell);
}
double NeighbourDensity::at(Vector2 const& uv) const {
    constexpr float diagonal = 1.5f;  // no point of the square is farther
    std::vector<PhotonGrid::Neighbour> found;
    auto const r2 = static_cast<double>(points_.nearest(
        {uv.x(), uv.y(), 0}, diagonal, k_, [](PhotonGrid::Entry const&, float) { return true; }, found));
    double const area = clipped_ ? disc_area_in_square(uv.cast<double>(), std::sqrt(r2)) : pi_double * r2;
    return static_cast<double>(k_ - 1) / (static_cast<double>(points_.size()) * area);
}

double disc_area_in_square(Eigen::Vector2d const& centre, double radius) {
    std::array<Eigen::Vector2d, 4> const corner{{{0, 0}, {1, 0}, {1, 1}, {0, 1}}};
    return disc_area_in_polygon(corner, centre, radius);
}

}  // namespace iride
