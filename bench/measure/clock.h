// SPDX-License-Identifier: Apache-2.0
// Times of runs, and what is quoted of several: the median, the least and the most.
#pragma once

#include <algorithm>
#include <vector>

#include "base/clock.h"

namespace iride::bench {

struct Spread {
    double median, least, most;
};
// Of at least one value.
inline Spread spread_of(std::vector<double> values) {
    std::ranges::sort(values);
    std::size_t const middle = values.size() / 2;
    double const median = values.size() % 2 ? values[middle] : (values[middle - 1] + values[middle]) / 2;
    return {median, values.front(), values.back()};
}

}  // namespace iride::bench
