// SPDX-License-Identifier: Apache-2.0
// Radiosity by chance: lines carry power, no form factor is stored or computed; patches come with error bars. With
// w_i = A_i b_i, W the power emitted, a line from i to j with probability F_ij:
//   stochastic-jacobi   increments dw' = D(rho) F^T dw: lines from patch i in proportion to dw_i, each of equal power
//   survival-walk       born by emitted power, goes on from i with probability rho_i; counts W / A_i where it goes on,
//   collision-walk      rho_i W / A_i wherever it arrives,
//   absorption-walk     rho_i W / ((1 - rho_i) A_i) where it ends
//   global-lines-jacobi increments by lines through the whole scene, both ways along each (global_lines.h)
// All estimate b - e. A walk serves all wavelengths: it carries their powers and goes on with probability
// (rho . w) / |w|, which is rho for one wavelength. [Sbert 1997] [Bekaert 1999]
#pragma once

#include <cstdint>
#include <functional>
#include <span>

#include "base/sampler.h"
#include "integrators/radiosity/system.h"

namespace iride::radiosity {

struct LineSource {
    // The patch that a line meets which leaves patch `from` by the cosine; -1: none.
    std::function<int(int from, Sampler&)> local;
    // The pairs that face each other along global line (series, number), and how often a line meets an area of 1 m^2.
    std::function<void(std::uint32_t series, std::uint32_t number, std::function<void(int, int)> const&)> global = {};
    double meetings = 0;
};

struct StochasticSolution {
    Spectra radiosity;
    Spectra standard_error;  // sampling of walks: from their scatter; of increments: as if lines were independent
    std::uint64_t lines;     // traced
    int iterations;          // rounds of increments; walks: 1
};

struct StochasticEntry {
    char const* name;
    char const* summary;
    // `lines`: about how many to trace. `system`: area, reflectance, emission.
    StochasticSolution (*solve)(System const& system, LineSource const& source, std::uint64_t lines,
                                std::uint64_t seed);
};
std::span<StochasticEntry const> stochastic_solvers();

// `walks` walks of one kind: the standard error times sqrt(walks) is that of a single walk.
enum class Walk { survival, collision, absorption };
StochasticSolution random_walks(System const& system, LineSource const& source, Walk kind, std::uint64_t walks,
                                std::uint64_t seed);

}  // namespace iride::radiosity
