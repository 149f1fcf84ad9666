// SPDX-License-Identifier: Apache-2.0
// Numerical stability: what is asked of the renderer, with what was found. The short form is a hidden test, the
// long one `iride bench stress`.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace iride::bench {

struct StressCase {
    std::string name;
    std::uint64_t samples;  // paths followed
    double value, limit;    // passes if value <= limit
    bool ok;
};

// `spp` paths for each of 24 x 24 pixels of every scene.
std::vector<StressCase> stress(int spp);

}  // namespace iride::bench
