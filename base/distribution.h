// SPDX-License-Identifier: Apache-2.0
// Piecewise constant distributions: a discrete one by Vose's alias method, and one on the unit square from a table of
// weights.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/sampler.h"

namespace iride {

// Chooses index i with probability weight[i] / sum. O(1) per sample. [Vose 1991]
class DiscreteDistribution {
  public:
    DiscreteDistribution() = default;
    // Weights >= 0, at least one > 0.
    explicit DiscreteDistribution(std::span<double const> weights);

    struct Choice {
        int index;
        float probability;
        float rest;  // u, rescaled to [0, 1) within the choice: usable again
    };
    Choice sample(float u) const;
    float probability(int index) const { return probability_[static_cast<std::size_t>(index)]; }
    int size() const { return static_cast<int>(probability_.size()); }
    double total_weight() const { return total_; }

  private:
    std::vector<float> probability_, threshold_;
    std::vector<int> alias_;
    double total_ = 0;
};

// Density on the unit square proportional to weight[row][column], constant in each cell: a row by its marginal, then a
// column, both by binary search in the cumulative, which keeps stratified points stratified.
class SquareDistribution {
  public:
    SquareDistribution() = default;
    SquareDistribution(std::span<double const> weights, int columns, int rows);

    struct Point {
        float x, y, density;  // density over the unit square
    };
    Point sample(Sample2 u) const;
    float density(float x, float y) const;
    double mean_weight() const { return mean_; }

  private:
    int columns_ = 0, rows_ = 0;
    std::vector<float> row_cumulative_, cumulative_;  // [rows + 1], [rows][columns + 1]
    std::vector<float> density_;                      // [rows][columns]
    double mean_ = 0;
};

}  // namespace iride
