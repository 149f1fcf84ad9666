// SPDX-License-Identifier: Apache-2.0
// Progressive refinement whose form factors are never stored: the row of the patch with the most unshot power is made,
// used and forgotten. Memory grows as n. [Cohen 1988]
#pragma once

#include "integrators/radiosity/form_factor_methods.h"
#include "integrators/radiosity/solvers.h"

namespace iride::radiosity {

// Until the unshot power is `tolerance` of the emitted, which the residual of the answer says. The answer is shot plus
// unshot plus the ambient share, as that of the stored solver "shooting".
Solution shoot_on_demand(System const& system, PatchMesh const& mesh, RowOfFactors const& row, Stop const& stop);

}  // namespace iride::radiosity
