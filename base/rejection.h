// SPDX-License-Identifier: Apache-2.0
// Rejection: points of the unit square are drawn, each with a height, until one lies below the density. What is kept
// has exactly that density; of the tries, integral(p) / bound are kept. For densities that have no inverse. [Press
// 2007]
#pragma once

#include "base/sampler.h"

namespace iride {

struct Accepted {
    Sample2 point;
    int tries;
};

// density(Sample2) of any scale, at most `bound`; next2() gives fresh pairs. After `most` tries the last point is
// given: with p / bound > 1/10 on average that happens once in 1e45.
template <class Density, class Numbers>
Accepted sample_by_rejection(Density const& density, float bound, Numbers& numbers) {
    constexpr int most = 1000;
    for (int tries = 1;; ++tries) {
        Sample2 const point = numbers.next2();
        if (numbers.next() * bound < density(point) || tries == most) return {point, tries};
    }
}

}  // namespace iride
