// SPDX-License-Identifier: Apache-2.0
// Statistical verdicts of the tests: chi-squared of directions against a density, and normal tails.
#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <vector>

#include "base/vector.h"

namespace iride::test {

// Upper tail of the chi-squared distribution by the regularised incomplete gamma function. [Press 2007, sec. 6.2]
inline double chi_squared_tail(double statistic, int degrees) {
    double const a = degrees / 2.0, x = statistic / 2;
    if (x <= 0) return 1;
    double const front = std::exp(-x + a * std::log(x) - std::lgamma(a));
    if (x < a + 1) {
        double term = 1 / a, sum = term;
        for (double n = a + 1; std::abs(term) > 1e-15 * sum; ++n) sum += term *= x / n;
        return 1 - sum * front;
    }
    double b = x + 1 - a, c = 1e300, d = 1 / b, h = d;
    for (int i = 1; i < 10000; ++i) {
        double const an = -i * (i - a);
        b += 2;
        d = 1 / (an * d + b);
        c = b + an / c;
        h *= d * c;
        if (std::abs(d * c - 1) < 1e-15) break;
    }
    return front * h;
}

// A mean and its standard error from means of independent repetitions.
struct Replicated {
    double mean, error;
};
template <class Repetition>
Replicated replicated(int count, Repetition&& repetition) {
    double sum = 0, sum_of_squares = 0;
    for (int i = 0; i < count; ++i) {
        double const x = repetition(i);
        sum += x;
        sum_of_squares += x * x;
    }
    double const mean = sum / count, n = count;
    return {mean, std::sqrt(std::max(0.0, sum_of_squares / n - mean * mean) / (n - 1))};
}

// Counts against expectations; what is expected fewer than 5 times is pooled.
class ChiSquared {
  public:
    void add(double expected, double count) {
        if (expected >= 5)
            account(expected, count);
        else
            pooled_expected_ += expected, pooled_count_ += count;
    }
    double p_value() const {
        ChiSquared all = *this;
        if (pooled_expected_ >= 5)
            all.account(pooled_expected_, pooled_count_);
        else if (pooled_count_ > 25 + 5 * pooled_expected_)
            return 0;  // counts where nothing can be
        return chi_squared_tail(all.statistic_, all.cells_ - 1);
    }

  private:
    void account(double expected, double count) {
        statistic_ += square(count - expected) / expected;
        ++cells_;
    }

    double statistic_ = 0, pooled_expected_ = 0, pooled_count_ = 0;
    int cells_ = 0;
};

// Directions on the sphere in cells of equal cos(theta) and phi: counts against the integral of a density.
class DirectionHistogram {
  public:
    explicit DirectionHistogram(int rows = 20, int columns = 40)
        : rows_(rows), columns_(columns), count_(static_cast<std::size_t>(rows * columns), 0.0) {}

    void add(Direction const& w) {
        ++total_;
        ++count_[cell(w)];
    }
    void add_nothing() { ++total_; }  // a sample that failed: the density's integral is below 1

    // density [1/sr], integrated by `n` x `n` small rules in every cell.
    double p_value(std::function<double(Direction const&)> const& density, int n = 16) const {
        ChiSquared verdict;
        double expected_sum = 0, counted = 0;
        for (int r = 0; r < rows_; ++r)
            for (int c = 0; c < columns_; ++c) {
                double const expected = total_ * integral(density, r, c, n);
                double const count = count_[static_cast<std::size_t>(r * columns_ + c)];
                expected_sum += expected;
                counted += count;
                verdict.add(expected, count);
            }
        double const lost = total_ - expected_sum;  // directions that cannot be
        constexpr double quadrature_error = 2e-4;   // over a narrow lobe: no loss to speak of
        if (lost > quadrature_error * total_) verdict.add(lost, total_ - counted);
        return verdict.p_value();
    }
    double integral_of(std::function<double(Direction const&)> const& density, int n = 16) const {
        double sum = 0;
        for (int r = 0; r < rows_; ++r)
            for (int c = 0; c < columns_; ++c) sum += integral(density, r, c, n);
        return sum;
    }

  private:
    std::size_t cell(Direction const& w) const {
        int const r = std::clamp(static_cast<int>((static_cast<double>(w.z()) + 1) / 2 * rows_), 0, rows_ - 1);
        double const turn = std::atan2(static_cast<double>(w.y()), static_cast<double>(w.x())) / (2 * pi_double) + 0.5;
        int const c = std::clamp(static_cast<int>(turn * columns_), 0, columns_ - 1);
        return static_cast<std::size_t>(r * columns_ + c);
    }
    double integral(std::function<double(Direction const&)> const& density, int r, int c, int n) const {
        // Two-point Gauss rule in z, where narrow lobes are steep; midpoints in phi.
        double sum = 0;
        double const dz = 2.0 / rows_ / n, dphi = 2 * pi_double / columns_ / n, gauss = 0.5 / std::sqrt(3.0);
        for (int i = 0; i < n; ++i)
            for (int j = 0; j < n; ++j)
                for (double side : {-gauss, gauss}) {
                    double const z = -1 + (r * n + i + 0.5 + side) * dz, phi = -pi_double + (c * n + j + 0.5) * dphi;
                    double const s = std::sqrt(std::max(0.0, 1 - z * z));
                    sum += density(VectorDouble(s * std::cos(phi), s * std::sin(phi), z).cast<float>()) / 2;
                }
        return sum * dz * dphi;
    }

    int rows_, columns_;
    std::vector<double> count_;
    double total_ = 0;
};

}  // namespace iride::test
