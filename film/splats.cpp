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
      pixel_count_(static_cast<std::size_t>(width) * static_cast<std::size_t>(height)),
      band_count_(static_cast<std::size_t>(band_count)),
      sum_(pixel_count_),
      sum_of_squares_(pixel_count_),
      sum_of_products_(pixel_count_),
      band_sum_(pixel_count_ * band_count_) {}

bool Splats::add(int x, int y, Xyz const& value) {
    auto const v = components(value);
    double const share = 1 / static_cast<double>(pixel_count_);
    for (double c : v)
        if (!(std::abs(c) * share <= largest)) return false;
    for (std::size_t c = 0; c < 3; ++c) {
        sum_[index(x, y)][c].add(v[c] * share);
        sum_of_squares_[index(x, y)][c].add(v[c] * share * v[c] * share);
        sum_of_products_[index(x, y)][c].add(v[c] * share * v[(c + 1) % 3] * share);
    }
    return true;
}

void Splats::add_to_band(int x, int y, int band, double value) {
    band_sum_[index(x, y) * band_count_ + static_cast<std::size_t>(band)].add(value /
                                                                              static_cast<double>(pixel_count_));
}

void Splats::count_path() { add_atomically(paths_, 1); }
void Splats::reject() { add_atomically(rejected_, 1); }

double Splats::pixels_per_path() const {
    return paths_ > 0 ? static_cast<double>(pixel_count_) / static_cast<double>(paths_) : 0;
}

Xyz Splats::mean(int x, int y) const {
    auto const& s = sum_[index(x, y)];
    double const scale = pixels_per_path();
    return {s[0].total() * scale, s[1].total() * scale, s[2].total() * scale};
}

MatrixDouble Splats::covariance(int x, int y) const {
    MatrixDouble m = MatrixDouble::Zero();
    if (paths_ == 0) return m;
    auto const& sum = sum_[index(x, y)];
    double const paths = static_cast<double>(paths_), scale = pixels_per_path() * pixels_per_path();
    for (std::size_t c = 0; c < 3; ++c) {
        std::size_t const d = (c + 1) % 3;
        double const squares = sum_of_squares_[index(x, y)][c].total(),
                     products = sum_of_products_[index(x, y)][c].total();
        auto const i = static_cast<Eigen::Index>(c), j = static_cast<Eigen::Index>(d);
        m(i, i) = std::max(0.0, squares - sum[c].total() * sum[c].total() / paths) * scale;
        m(i, j) = m(j, i) = (products - sum[c].total() * sum[d].total() / paths) * scale;
    }
    return m;
}

Xyz Splats::variance(int x, int y) const {
    MatrixDouble const m = covariance(x, y);
    return {m(0, 0), m(1, 1), m(2, 2)};
}

void Splats::add(Splats const& other) {
    check(other.sum_.size() == sum_.size() && other.band_sum_.size() == band_sum_.size(),
          "splats are added up of pictures of one size and one set of bands");
    auto const add_all = [](auto& to, auto const& from) {
        for (std::size_t i = 0; i < to.size(); ++i)
            for (std::size_t c = 0; c < 3; ++c) to[i][c] += from[i][c];
    };
    add_all(sum_, other.sum_);
    add_all(sum_of_squares_, other.sum_of_squares_);
    add_all(sum_of_products_, other.sum_of_products_);
    for (std::size_t i = 0; i < band_sum_.size(); ++i) band_sum_[i] += other.band_sum_[i];
    paths_ += other.paths_;
    rejected_ += other.rejected_;
}

double Splats::band(int x, int y, int band) const {
    return band_sum_[index(x, y) * band_count_ + static_cast<std::size_t>(band)].total() * pixels_per_path();
}

}  // namespace iride
