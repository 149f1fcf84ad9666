// SPDX-License-Identifier: Apache-2.0
// Adaptive substructuring: where radiosity varies, patches are split into elements that receive; light still comes
// from the whole patches, so the system stays as small as it was:
//   F_ij = sum over elements s of i of A_s F_sj / A_i,    b_s = e_i + rho_i sum_j F_sj b_j,
// hence sum_s A_s b_s = A_i b_i. [Cohen 1986]
#pragma once

#include <vector>

#include "integrators/radiosity/patches.h"
#include "integrators/radiosity/system.h"

namespace iride::radiosity {

struct Elements {
    PatchMesh mesh;
    std::vector<int> parent;  // [element] the patch it is part of
};

// Each patch its own element.
Elements whole_patches(PatchMesh const& mesh);

// Flagged elements in four, both sides of a surface alike; their neighbours are cut so that no T-junction is left.
Elements split(Elements const& elements, std::vector<char> const& flagged);

// Elements over which b, summed over wavelengths, varies by more than `contrast` of its mean there.
std::vector<char> varying(Elements const& elements, Spectra const& b, double contrast);

// The patches' form factors from those of the elements, [element][patch].
FormFactors factors_of_patches(System const& system, Elements const& elements, FormFactors const& of_elements);

// b_s from the patches' b.
Spectra radiosity_of_elements(System const& system, Elements const& elements, FormFactors const& of_elements,
                              Spectra const& b);

}  // namespace iride::radiosity
