// SPDX-License-Identifier: Apache-2.0
// Form factors of all patches of a scene, occlusion included. Each method gives, patch by patch, shares of directions:
//   rays        local lines: points spread over the patch, directions by the cosine; each ray carries 1 / N
//   hemicube    from the centre, a ray through every cell of a cube of N x N tops and N x N/2 sides; a cell carries
//               dA / (pi (1 + x^2 + y^2)^2), at the sides z dA / (pi (1 + y^2 + z^2)^2); the weights sum to 1 + .542 /
//               N^2
//   hemisphere  from the centre, N x N equal parts of the unit disc lifted to the hemisphere (Nusselt's analogue)
//   analytic    contour integrals (polygon_form_factor.h) times the share of unoccluded lines between points of both
//   global-lines  lines through the scene, uniform among all lines that meet its bounding sphere; each passes through
//               all it meets, and serves every pair that faces each other along it
// The first three make a row at a time, for other receivers than the patches as well. [Cohen 1985] [Sbert 1993]
#pragma once

#include <functional>
#include <span>

#include "integrators/radiosity/patches.h"
#include "integrators/radiosity/row_sums.h"
#include "integrators/radiosity/system.h"

namespace iride::radiosity {

// What receiver i of `receivers` sees of the patches of a tracer.
using RowOfFactors = std::function<void(PatchMesh const& receivers, std::size_t i, RowSums& row)>;

struct FormFactorMethod {
    char const* name;
    char const* summary;
    int fineness;  // default of N: rays, cells of an edge, shadow rays a pair, lines per patch
    double (*entries)(double patches, int fineness);                             // the most of a row
    RowOfFactors (*rows)(PatchTracer const&, int fineness);                      // keeps a reference; null: no rows
    FormFactors (*compute)(PatchMesh const&, PatchTracer const&, int fineness);  // null: never stored (hierarchy.h)
};
std::span<FormFactorMethod const> form_factor_methods();

// A row by a method that has rows, for every receiver, of `columns` patches.
FormFactors assemble(PatchMesh const& receivers, std::size_t columns, RowOfFactors const& row);

// A_i F_ij and A_j F_ji replaced by their mean, then scaled alike from both sides until the rows sum to what they did.
void make_reciprocal(System& system);

}  // namespace iride::radiosity
