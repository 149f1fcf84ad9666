// SPDX-License-Identifier: Apache-2.0
#include "film/film.h"

#include <cmath>
#include <limits>

namespace iride {

namespace {

bool is_step(SpectralFunction const& f) {
    auto const* const table = std::get_if<TabulatedShape>(&f.shape());
    return table && table->step;
}

}  // namespace

Film::Film(int width, int height, Observer const& observer, WavelengthGrid const& grid, std::optional<Bands> bands)
    : pixels_(width, height),
      observer_(observer),
      bands_(bands),
      exact_observer_(is_step(observer.xbar) || is_step(observer.ybar) || is_step(observer.zbar)) {
    if (bands_) band_sum_.assign(pixels_.pixel.size() * static_cast<std::size_t>(bands_->count), 0.0);
    for (int i = 0; i < grid.count; ++i) response_.push_back(response(grid.first_nm + i));
}

Film::Response Film::response(double nm) const {
    Xyz const c = observer_.at(nm);
    double const scale = 1 / observer_.ybar_integral;
    return Response{static_cast<float>(c.X * scale), static_cast<float>(c.Y * scale), static_cast<float>(c.Z * scale),
                    0};
}

void Film::add(int x, int y, Wavelengths const& wavelengths, Radiance const& radiance) {
    Pixel& pixel = pixels_.at(x, y);
    auto const power = radiance / wavelengths.density;  // L_i / p_i
    Response total{};
    for (int i = 0; i < lane_count; ++i) {
        if (exact_observer_) {
            total += response(static_cast<double>(wavelengths.nm[i])) * power[i];
        } else {
            Response const* const cell = response_.data() + wavelengths.cell[i];
            total += (cell[0] + wavelengths.fraction[i] * (cell[1] - cell[0])) * power[i];
        }
    }
    for (std::size_t c = 0; c < 3; ++c) {
        double const value = static_cast<double>(total[c]) / lane_count;
        pixel.sum[c] += value;
        pixel.sum_of_squares[c] += value * value;
    }
    ++pixel.count;
    if (bands_) add_to_bands(x, y, wavelengths, power);
}

void Film::add_to_bands(int x, int y, Wavelengths const& wavelengths,
                        Sampled<dim::spectral_radiance / dim::per_nanometre> power) {
    double* const sums = band_sum_.data() + band_offset(x, y);
    double const width = bands_->width_nm();
    for (int i = 0; i < lane_count; ++i) {
        double const place = (static_cast<double>(wavelengths.nm[i]) - bands_->range.min_nm) / width;
        if (place < 0 || place > bands_->count) continue;
        int const band = std::min(static_cast<int>(place), bands_->count - 1);
        sums[band] += static_cast<double>(power[i]) / (lane_count * width);
    }
}

void Film::reject(int x, int y, Rejection cause) { ++pixels_.at(x, y).rejected[static_cast<std::size_t>(cause)]; }

std::size_t Film::band_offset(int x, int y) const {
    return (static_cast<std::size_t>(y) * static_cast<std::size_t>(width()) + static_cast<std::size_t>(x)) *
           static_cast<std::size_t>(bands_->count);
}

Xyz Film::mean(int x, int y) const {
    Pixel const& p = pixels_.at(x, y);
    if (p.count == 0) return {};
    return {p.sum[0] / p.count, p.sum[1] / p.count, p.sum[2] / p.count};
}

Xyz Film::variance(int x, int y) const {
    Pixel const& p = pixels_.at(x, y);
    constexpr double unknown = std::numeric_limits<double>::infinity();
    if (p.count < 2) return {unknown, unknown, unknown};
    double const n = p.count;
    auto const of = [&](std::size_t c) {
        double const mean = p.sum[c] / n;
        return std::max(0.0, p.sum_of_squares[c] / n - mean * mean) / (n - 1);
    };
    return {of(0), of(1), of(2)};
}

double Film::band(int x, int y, int band) const {
    std::uint32_t const count = pixels_.at(x, y).count;
    return count > 0 ? band_sum_[band_offset(x, y) + static_cast<std::size_t>(band)] / count : 0;
}

std::array<std::uint64_t, rejection_count> Film::rejected() const {
    std::array<std::uint64_t, rejection_count> total{};
    for (Pixel const& p : pixels_.pixel)
        for (std::size_t c = 0; c < total.size(); ++c) total[c] += p.rejected[c];
    return total;
}

double Film::relative_error() const {
    double total = 0;
    for (int y = 0; y < height(); ++y)
        for (int x = 0; x < width(); ++x) {
            Xyz const m = mean(x, y), v = variance(x, y);
            total += v.X / (m.X * m.X + 0.01) + v.Y / (m.Y * m.Y + 0.01) + v.Z / (m.Z * m.Z + 0.01);
        }
    return std::sqrt(total / (3.0 * width() * height()));
}

}  // namespace iride
