// SPDX-License-Identifier: Apache-2.0
#include "film/splats.h"

#include <algorithm>
#include <atomic>
#include <cmath>

#include "base/check.h"

namespace iride {

namespace {

constexpr double unit_high = 0x1p-12, unit_low = 0x1p-44;

void add_atomically(std::int64_t& to, std::int64_t value) {
    if (value != 0) std::atomic_ref(to).fetch_add(value, std::memory_order_relaxed);
}

std::array<double, 3> components(Xyz const& c) { return {c.X, c.Y, c.Z}; }

}  // namespace

void Splats::Sum::add(double value) {
    double const whole = std::floor(value * (1 / unit_high));
    constexpr double half = 0.5;  // rounds what is not negative
    add_atomically(high, static_cast<std::int64_t>(whole));
    add_atomically(low, static_cast<std::int64_t>((value - whole * unit_high) * (1 / unit_low) + half));
}

double Splats::Sum::total() const {
    return static_cast<double>(high) * unit_high + static_cast<double>(low) * unit_low;
}

Splats::Splats(int width, int height, int band_count)
    : width_(width),
      band_count_(static_cast<std::size_t>(band_count)),
      pixels_(static_cast<std::size_t>(width) * static_cast<std::size_t>(height)),
      band_sum_(pixels_.size() * band_count_) {}

bool Splats::add(int x, int y, Xyz const& value) {
    auto const v = components(value);
    double const share = 1 / pixel_count();
    for (double c : v)
        if (!(std::abs(c) * share <= largest)) return false;
    Pixel& pixel = pixels_[index(x, y)];
    for (std::size_t c = 0; c < 3; ++c) {
        pixel.sum[c].add(v[c] * share);
        pixel.sum_of_squares[c].add(v[c] * share * v[c] * share);
        pixel.sum_of_products[c].add(v[c] * share * v[(c + 1) % 3] * share);
    }
    return true;
}

void Splats::add_to_band(int x, int y, int band, double value) {
    band_sum_[index(x, y) * band_count_ + static_cast<std::size_t>(band)].add(value / pixel_count());
}

void Splats::count_paths(std::uint64_t count, std::uint32_t weight) {
    auto const n = static_cast<std::int64_t>(count), w = static_cast<std::int64_t>(weight);
    add_atomically(weight_, n * w);
    add_atomically(squared_weight_, n * w * w);
}
void Splats::reject() { add_atomically(rejected_, 1); }

double Splats::pixels_per_weight() const { return weight_ > 0 ? pixel_count() / static_cast<double>(weight_) : 0; }

Xyz Splats::mean(int x, int y) const {
    auto const& s = pixels_[index(x, y)].sum;
    double const scale = pixels_per_weight();
    return {s[0].total() * scale, s[1].total() * scale, s[2].total() * scale};
}

MatrixDouble Splats::covariance(int x, int y) const {
    MatrixDouble m = MatrixDouble::Zero();
    if (weight_ == 0) return m;
    auto const& [sum, sum_of_squares, sum_of_products, accompanied] = pixels_[index(x, y)];
    double const per_path = static_cast<double>(squared_weight_) / square(static_cast<double>(weight_)),
                 scale = square(pixels_per_weight());
    for (std::size_t c = 0; c < 3; ++c) {
        std::size_t const d = (c + 1) % 3;
        double const squares = sum_of_squares[c].total(), products = sum_of_products[c].total();
        auto const i = static_cast<Eigen::Index>(c), j = static_cast<Eigen::Index>(d);
        m(i, i) = std::max(0.0, squares - sum[c].total() * sum[c].total() * per_path) * scale;
        m(i, j) = m(j, i) = (products - sum[c].total() * sum[d].total() * per_path) * scale;
    }
    return m;
}

Xyz Splats::variance(int x, int y) const {
    MatrixDouble const m = covariance(x, y);
    return {m(0, 0), m(1, 1), m(2, 2)};
}

void Splats::add(Splats const& other) {
    check(other.pixels_.size() == pixels_.size() && other.band_sum_.size() == band_sum_.size(),
          "splats are added up of pictures of one size and one set of bands");
    for (std::size_t i = 0; i < pixels_.size(); ++i) {
        for (auto sums : {&Pixel::sum, &Pixel::sum_of_squares, &Pixel::sum_of_products})
            for (std::size_t c = 0; c < 3; ++c) (pixels_[i].*sums)[c] += (other.pixels_[i].*sums)[c];
        pixels_[i].accompanied += other.pixels_[i].accompanied;
    }
    for (std::size_t i = 0; i < band_sum_.size(); ++i) band_sum_[i] += other.band_sum_[i];
    weight_ += other.weight_;
    squared_weight_ += other.squared_weight_;
    rejected_ += other.rejected_;
}

double Splats::band(int x, int y, int band) const {
    return band_sum_[index(x, y) * band_count_ + static_cast<std::size_t>(band)].total() * pixels_per_weight();
}

}  // namespace iride
