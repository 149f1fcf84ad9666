// SPDX-License-Identifier: Apache-2.0
// Sums over the columns of one row of a sparse matrix: adding costs no search, reading no walk over zeros.
#pragma once

#include <algorithm>
#include <vector>

namespace iride::radiosity {

class RowSums {
  public:
    explicit RowSums(std::size_t columns) : value_(columns, 0.0) {}

    void add(int column, double value) {
        double& sum = value_[static_cast<std::size_t>(column)];
        if (sum == 0) touched_.push_back(column);
        sum += value;
    }
    // Calls use(column, sum) in the order of the columns, and starts anew.
    template <class Use>
    void take(Use const& use) {
        std::ranges::sort(touched_);
        for (int column : touched_) {
            double& sum = value_[static_cast<std::size_t>(column)];
            if (sum != 0) use(column, sum);  // 0: a column that came twice
            sum = 0;
        }
        touched_.clear();
    }
    std::size_t size() const { return touched_.size(); }

  private:
    std::vector<double> value_;
    std::vector<int> touched_;
};

}  // namespace iride::radiosity
