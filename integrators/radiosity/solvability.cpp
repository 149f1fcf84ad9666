// SPDX-License-Identifier: Apache-2.0
#include "integrators/radiosity/solvability.h"

#include <vector>

namespace iride::radiosity {

std::optional<Trapped> light_that_is_never_lost(System const& system) {
    constexpr double nothing = 1e-4;  // a share lost at a bounce below which 1e4 bounces would be needed
    if ((system.reflectance <= 1 - nothing).all()) return std::nullopt;
    Eigen::ArrayXd const arriving = gathered_shares(system, Spectra::Ones(system.patches(), 1)).col(0);
    auto const n = static_cast<std::size_t>(system.patches());
    for (Eigen::Index w = 0; w < system.wavelengths(); ++w) {
        // Light is lost at a patch that absorbs or sees out, and then at all that send light there.
        Eigen::ArrayXd lost = (system.reflectance.col(w) > 1 - nothing && arriving > 1 - nothing)
                                  .select(Eigen::ArrayXd::Zero(system.patches()), 1.0);
        for (std::size_t round = 0; round < n; ++round) {
            Spectra const flag = lost;
            Eigen::ArrayXd const next = (gathered_shares(system, flag).col(0) > nothing).select(1.0, lost);
            if ((next == lost).all()) break;
            lost = next;
        }
        Eigen::Index patch;
        if (lost.minCoeff(&patch) == 0) return Trapped{static_cast<std::size_t>(patch), w};
    }
    return std::nullopt;
}

}  // namespace iride::radiosity
