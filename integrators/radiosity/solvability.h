// SPDX-License-Identifier: Apache-2.0
// Whether light that leaves any patch is lost in the end: absorbed, or gone out of the scene. If not, no radiosity
// balances what is emitted: sum over bounces of rho^k does not converge for rho = 1 in a closed scene.
#pragma once

#include <optional>

#include "integrators/radiosity/system.h"

namespace iride::radiosity {

// A patch whose light is lost nowhere at some wavelength, and that wavelength's column; none if there is no such patch.
struct Trapped {
    std::size_t patch;
    Eigen::Index wavelength;
};
std::optional<Trapped> light_that_is_never_lost(System const& system);

}  // namespace iride::radiosity
