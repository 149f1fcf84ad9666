// SPDX-License-Identifier: Apache-2.0
#include "base/distribution.h"

#include <algorithm>
#include <numeric>

#include "base/check.h"

namespace iride {

DiscreteDistribution::DiscreteDistribution(std::span<double const> weights) {
    std::size_t const n = weights.size();
    total_ = std::accumulate(weights.begin(), weights.end(), 0.0);
    check(total_ > 0, "a distribution has a positive weight");
    std::vector<double> share(n);
    std::vector<std::size_t> small, large;
    threshold_.assign(n, 1);
    alias_.resize(n);
    for (std::size_t i = 0; i < n; ++i) {
        probability_.push_back(static_cast<float>(weights[i] / total_));
        share[i] = weights[i] / total_ * static_cast<double>(n);
        alias_[i] = static_cast<int>(i);
        (share[i] < 1 ? small : large).push_back(i);
    }
    while (!small.empty() && !large.empty()) {
        std::size_t const poor = small.back(), rich = large.back();
        small.pop_back();
        threshold_[poor] = static_cast<float>(share[poor]);
        alias_[poor] = static_cast<int>(rich);
        share[rich] -= 1 - share[poor];
        if (share[rich] < 1) large.pop_back(), small.push_back(rich);
    }
}

DiscreteDistribution::Choice DiscreteDistribution::sample(float u) const {
    auto const n = static_cast<float>(threshold_.size());
    auto const bin = std::min(static_cast<std::size_t>(u * n), threshold_.size() - 1);
    float const within = u * n - static_cast<float>(bin), threshold = threshold_[bin];
    bool const own = within < threshold;
    int const index = own ? static_cast<int>(bin) : alias_[bin];
    float const rest = own ? within / threshold : (within - threshold) / (1 - threshold);
    return {index, probability(index), std::clamp(rest, 0.0f, one_minus_epsilon)};
}

SquareDistribution::SquareDistribution(std::span<double const> weights, int columns, int rows)
    : columns_(columns), rows_(rows) {
    auto const width = static_cast<std::size_t>(columns);
    double const total = std::accumulate(weights.begin(), weights.end(), 0.0);
    check(total > 0, "a distribution has a positive weight");
    mean_ = total / static_cast<double>(weights.size());
    for (double w : weights) density_.push_back(static_cast<float>(w / mean_));
    double above = 0;
    row_cumulative_.push_back(0);
    for (std::size_t y = 0; y < static_cast<std::size_t>(rows); ++y) {
        auto const row = weights.subspan(y * width, width);
        double const row_total = std::accumulate(row.begin(), row.end(), 0.0);
        double left = 0;
        cumulative_.push_back(0);
        for (double w : row) cumulative_.push_back(static_cast<float>(row_total > 0 ? (left += w) / row_total : 0));
        row_cumulative_.push_back(static_cast<float>((above += row_total) / total));
    }
}

namespace {

// The cell of a cumulative table that holds u, and the place in it.
struct Cell {
    std::size_t index;
    float fraction;
};
Cell find(std::span<float const> cumulative, float u) {
    auto const above = std::upper_bound(cumulative.begin(), cumulative.end() - 1, u);
    auto const i = static_cast<std::size_t>(std::max<std::ptrdiff_t>(0, above - cumulative.begin() - 1));
    float const width = cumulative[i + 1] - cumulative[i];
    return {i, width > 0 ? std::clamp((u - cumulative[i]) / width, 0.0f, one_minus_epsilon) : 0};
}

}  // namespace

SquareDistribution::Point SquareDistribution::sample(Sample2 u) const {
    Cell const row = find(row_cumulative_, u.y);
    auto const width = static_cast<std::size_t>(columns_);
    Cell const column = find(std::span(cumulative_).subspan(row.index * (width + 1), width + 1), u.x);
    return {(static_cast<float>(column.index) + column.fraction) / static_cast<float>(columns_),
            (static_cast<float>(row.index) + row.fraction) / static_cast<float>(rows_),
            density_[row.index * width + column.index]};
}

float SquareDistribution::density(float x, float y) const {
    auto const column = std::clamp(static_cast<int>(x * static_cast<float>(columns_)), 0, columns_ - 1);
    auto const row = std::clamp(static_cast<int>(y * static_cast<float>(rows_)), 0, rows_ - 1);
    return density_[static_cast<std::size_t>(row * columns_ + column)];
}

}  // namespace iride
