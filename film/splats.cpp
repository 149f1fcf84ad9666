// SPDX-License-Identifier: Apache-2.0
#include "film/splats.h"

#include <algorithm>
#include <atomic>
#include <cmath>

namespace iride {

namespace {

constexpr double unit_high = 0x1p-12, unit_low = 0x1p-44;

void add_atomically(std::int64_t& to, std::int64_t value) {
    if (value != 0) std::atomic_ref(to).fetch_add(value, std::memory_order_relaxed);
}

std::array<double, 3> components(Xyz const& c) { return {c.X, c.Y, c.Z}; }

}  // namespace

void Splats::Sum::add(double value) {
    double const whole = std::floor(value / unit_high);
    add_atomically(high, static_cast<std::int64_t>(whole));
    add_atomically(low, std::llround((value - whole * unit_high) / unit_low));
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
      band_sum_(pixel_count_ * band_count_) {}

bool Splats::add(int x, int y, Xyz const& value) {
    auto const v = components(value);
    double const share = 1 / static_cast<double>(pixel_count_);
    for (double c : v)
        if (!(std::abs(c) * share <= largest)) return false;
    for (std::size_t c = 0; c < 3; ++c) {
        sum_[index(x, y)][c].add(v[c] * share);
        sum_of_squares_[index(x, y)][c].add(v[c] * share * v[c] * share);
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

Xyz Splats::variance(int x, int y) const {
    std::array<double, 3> v{};
    for (std::size_t c = 0; c < 3 && paths_ > 0; ++c) {
        double const sum = sum_[index(x, y)][c].total(), squares = sum_of_squares_[index(x, y)][c].total();
        v[c] = std::max(0.0, squares - sum * sum / static_cast<double>(paths_)) * pixels_per_path() * pixels_per_path();
    }
    return {v[0], v[1], v[2]};
}

double Splats::band(int x, int y, int band) const {
    return band_sum_[index(x, y) * band_count_ + static_cast<std::size_t>(band)].total() * pixels_per_path();
}

}  // namespace iride
