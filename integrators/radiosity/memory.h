// SPDX-License-Identifier: Apache-2.0
// What a radiosity solution will take, before it is taken.
#pragma once

#include "integrators/radiosity/form_factor_methods.h"

namespace iride::radiosity {

// Bytes for patches with their spectra and, unless `method` is null, its form factors; to some tens of per cents.
// `mirrors`: the most, if all is seen by mirrors.
double memory_needed(double patches, int wavelengths, FormFactorMethod const* method, int fineness,
                     bool mirrors = false);

// Throws InputError that names estimate, what is allowed, and what takes less.
void refuse_if_too_large(double patches, int wavelengths, FormFactorMethod const* method, int fineness,
                         double allowed_bytes, bool mirrors = false);

}  // namespace iride::radiosity
