// SPDX-License-Identifier: Apache-2.0
#include "film/film.h"

#include <cmath>
#include <limits>

#include "base/check.h"

namespace iride {

namespace {

bool is_step(SpectralFunction const& f) {
    auto const* const table = std::get_if<TabulatedShape>(&f.shape());
    return table && table->step;
}

}  // namespace

FilmPixel FilmPixel::of(Xyz const& mean, MatrixDouble const& covariance, std::uint32_t count, double each) {
    double const n = count;
    FilmPixel p;
    p.count = count;
    double const w = p.weight = n * each;
    if (count == 0) return p;
    VectorDouble const m = to_vector(mean);
    for (Eigen::Index c = 0; c < 3; ++c) {
        Eigen::Index const next = (c + 1) % 3;
        auto const i = static_cast<std::size_t>(c);
        double const spread = count > 1 ? covariance(c, c) * (n - 1) : 0;
        double const together = count > 1 ? covariance(c, next) * (n - 1) : 0;
        p.sum[i] = m[c] * w;
        p.sum_of_squares[i] = w * (m[c] * m[c] + spread);
        p.sum_of_products[i] = w * (m[c] * m[next] + together);
    }
    return p;
}

Film::Film(int width, int height, Observer const& observer, WavelengthGrid const& grid, std::optional<Bands> bands)
    : Film(width, height, {0, 0, width, height}, observer, grid, bands) {}

Film::Film(int width, int height, FilmPlace const& place, Observer const& observer, WavelengthGrid const& grid,
           std::optional<Bands> bands)
    : pixels_(width, height),
      place_(place),
      observer_(&observer),
      bands_(bands),
      exact_observer_(is_step(observer.xbar) || is_step(observer.ybar) || is_step(observer.zbar)) {
    if (bands_) band_sum_.assign(pixels_.pixel.size() * static_cast<std::size_t>(bands_->count), 0.0);
    for (int i = 0; i < grid.count; ++i) response_.push_back(response(grid.first_nm + i));
}

Film::Response Film::response(double nm) const {
    Xyz const c = observer_->at(nm);
    double const scale = 1 / observer_->ybar_integral;
    return Response{static_cast<float>(c.X * scale), static_cast<float>(c.Y * scale), static_cast<float>(c.Z * scale),
                    0};
}

[[gnu::always_inline]] inline Xyz Film::colour_of(Wavelengths const& wavelengths, Power const& power) const {
    Response total{};
    for (int i = 0; i < lane_count; ++i) {
        if (exact_observer_) {
            total += response(static_cast<double>(wavelengths.nm[i])) * power[i];
        } else {
            Response const* const cell = response_.data() + wavelengths.cell[i];
            total += (cell[0] + wavelengths.fraction[i] * (cell[1] - cell[0])) * power[i];
        }
    }
    auto const component = [&](int c) { return static_cast<double>(total[c]) / lane_count; };
    return {component(0), component(1), component(2)};
}

void Film::add(int x, int y, Wavelengths const& wavelengths, Radiance const& radiance, std::uint32_t weight) {
    FilmPixel& pixel = pixels_.at(x, y);
    Power const power = radiance / wavelengths.density;
    Xyz const colour = colour_of(wavelengths, power);
    std::array<double, 3> const value{colour.X, colour.Y, colour.Z};
    double const w = weight;
    for (std::size_t c = 0; c < 3; ++c) {
        pixel.sum[c] += w * value[c];
        pixel.sum_of_squares[c] += w * value[c] * value[c];
        pixel.sum_of_products[c] += w * value[c] * value[(c + 1) % 3];
    }
    pixel.weight += w;
    ++pixel.count;
    if (!bands_) return;
    double* const sums = band_sum_.data() + band_offset(x, y);
    for_bands(wavelengths, power, [&](int band, double v) { sums[band] += w * v; });
}

void Film::splat(int x, int y, Wavelengths const& wavelengths, Radiance const& radiance, std::uint32_t weight) {
    Power const power = radiance / wavelengths.density * static_cast<float>(weight);
    if (!is_finite(radiance) || !splats_->add(x, y, colour_of(wavelengths, power))) return splats_->reject();
    if (bands_) for_bands(wavelengths, power, [&](int band, double v) { splats_->add_to_band(x, y, band, v); });
}

template <class Add>
void Film::for_bands(Wavelengths const& wavelengths, Power const& power, Add&& add) const {
    double const width = bands_->width_nm();
    for (int i = 0; i < lane_count; ++i) {
        double const place = (static_cast<double>(wavelengths.nm[i]) - bands_->range.min_nm) / width;
        if (place < 0 || place > bands_->count) continue;
        int const band = std::min(static_cast<int>(place), bands_->count - 1);
        add(band, static_cast<double>(power[i]) / (lane_count * width));
    }
}

void Film::reject(int x, int y, Rejection cause) { ++pixels_.at(x, y).rejected[static_cast<std::size_t>(cause)]; }

void Film::add(Film const& other) {
    if (other.splats_) {
        check(other.place_ == place_ && other.width() == width() && other.height() == height(),
              "splats belong to the whole picture");
        add_splat_layer();
        splats_->add(*other.splats_);
    }
    for (int y = 0; y < other.height(); ++y)
        for (int x = 0; x < other.width(); ++x) {
            int const here_x = x + other.place_.x0 - place_.x0, here_y = y + other.place_.y0 - place_.y0;
            if (here_x < 0 || here_y < 0 || here_x >= width() || here_y >= height()) continue;
            FilmPixel& to = pixels_.at(here_x, here_y);
            FilmPixel const& from = other.pixels_.at(x, y);
            for (std::size_t c = 0; c < 3; ++c) {
                to.sum[c] += from.sum[c];
                to.sum_of_squares[c] += from.sum_of_squares[c];
                to.sum_of_products[c] += from.sum_of_products[c];
            }
            for (std::size_t c = 0; c < to.rejected.size(); ++c) to.rejected[c] += from.rejected[c];
            to.weight += from.weight;
            to.count += from.count;
            if (!bands_) continue;
            double* const sums = band_sum_.data() + band_offset(here_x, here_y);
            double const* const more = other.band_sum_.data() + other.band_offset(x, y);
            for (int b = 0; b < bands_->count; ++b) sums[b] += more[b];
        }
}

Film Film::half_and_half(Film const& a, Film const& b) {
    Film film = a;
    for (int y = 0; y < a.height(); ++y)
        for (int x = 0; x < a.width(); ++x) {
            FilmPixel& pixel = film.pixels_.at(x, y);
            FilmPixel const &p = a.pixels_.at(x, y), &q = b.pixels_.at(x, y);
            std::uint32_t const count = p.count + q.count;
            if (p.count == 0 || q.count == 0) {  // nothing but rejected samples in one of them
                if (p.count == 0) pixel = q;
            } else {
                MatrixDouble const covariance = (a.covariance(x, y) + b.covariance(x, y)) / 4;
                pixel = FilmPixel::of(0.5 * (a.mean(x, y) + b.mean(x, y)), covariance, count);
            }
            for (std::size_t c = 0; c < pixel.rejected.size(); ++c) pixel.rejected[c] = p.rejected[c] + q.rejected[c];
            if (!film.bands_) continue;
            double* const sums = film.band_sum_.data() + film.band_offset(x, y);
            for (int k = 0; k < film.bands_->count; ++k) {
                double const share = p.count == 0 || q.count == 0 ? 1 : 0.5;
                sums[k] = share * pixel.weight * (a.band(x, y, k) + b.band(x, y, k));
            }
        }
    return film;
}

std::size_t Film::band_offset(int x, int y) const {
    return (static_cast<std::size_t>(y) * static_cast<std::size_t>(width()) + static_cast<std::size_t>(x)) *
           static_cast<std::size_t>(bands_->count);
}

double Film::share_of_splats(int x, int y) const {
    FilmPixel const& p = pixels_.at(x, y);
    return p.count == 0 ? 1 : splats_->accompanied(x, y) / p.weight;
}

Xyz Film::mean(int x, int y) const {
    FilmPixel const& p = pixels_.at(x, y);
    Xyz const light = splats_ ? share_of_splats(x, y) * splats_->mean(x, y) : Xyz{};
    if (p.count == 0) return light;
    return {p.sum[0] / p.weight + light.X, p.sum[1] / p.weight + light.Y, p.sum[2] / p.weight + light.Z};
}

Xyz Film::variance(int x, int y) const {
    FilmPixel const& p = pixels_.at(x, y);
    constexpr double unknown = std::numeric_limits<double>::infinity();
    if (p.count < 2) return {unknown, unknown, unknown};
    auto const of = [&](std::size_t c) {
        double const mean = p.sum[c] / p.weight;
        return std::max(0.0, p.sum_of_squares[c] / p.weight - mean * mean) / (p.count - 1);
    };
    Xyz const light = splats_ ? square(share_of_splats(x, y)) * splats_->variance(x, y) : Xyz{};
    return {of(0) + light.X, of(1) + light.Y, of(2) + light.Z};
}

MatrixDouble Film::covariance(int x, int y) const {
    FilmPixel const& p = pixels_.at(x, y);
    Xyz const v = variance(x, y);
    MatrixDouble m = MatrixDouble::Zero();
    if (splats_) m = square(share_of_splats(x, y)) * splats_->covariance(x, y);
    m.diagonal() = to_vector(v);
    if (p.count < 2) return m;
    double const n = p.count, w = p.weight;
    for (Eigen::Index c = 0; c < 3; ++c) {
        Eigen::Index const next = (c + 1) % 3;
        auto const i = static_cast<std::size_t>(c), j = static_cast<std::size_t>(next);
        double const camera = (p.sum_of_products[i] / w - p.sum[i] / w * (p.sum[j] / w)) / (n - 1);
        m(c, next) = m(next, c) = m(c, next) + camera;
    }
    return m;
}

double Film::band(int x, int y, int band) const {
    double const weight = pixels_.at(x, y).weight,
                 light = splats_ ? share_of_splats(x, y) * splats_->band(x, y, band) : 0;
    return (weight > 0 ? band_sum_[band_offset(x, y) + static_cast<std::size_t>(band)] / weight : 0) + light;
}

std::array<std::uint64_t, rejection_count> Film::rejected() const {
    std::array<std::uint64_t, rejection_count> total{};
    for (FilmPixel const& p : pixels_.pixel)
        for (std::size_t c = 0; c < total.size(); ++c) total[c] += p.rejected[c];
    if (splats_) total[static_cast<std::size_t>(Rejection::not_finite)] += splats_->rejected();
    return total;
}

std::uint64_t Film::total_samples() const {
    std::uint64_t total = 0;
    for (FilmPixel const& p : pixels_.pixel) total += p.count;
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
