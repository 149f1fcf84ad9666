// SPDX-License-Identifier: Apache-2.0
#include "integrators/radiosity/memory.h"

#include <fmt/format.h>

#include "base/diagnostics.h"

namespace iride::radiosity {

double memory_needed(double patches, int wavelengths, FormFactorMethod const* method, int fineness, bool mirrors) {
    constexpr double spectra = 10,     // of 8 bytes a wavelength: reflectance, emission, solution, the solver's own
        geometry = 1000,               // a patch: corners, vertices, the intersector's triangles and tree
        copies = 5, entry_bytes = 12,  // of the matrix while it is made reciprocal
        mirror_copies = 2;             // of a float a wavelength for each entry
    double bytes = patches * (geometry + spectra * 8 * wavelengths);
    if (method && method->entries)
        bytes += patches * method->entries(patches, fineness) *
                 (copies * entry_bytes + (mirrors ? mirror_copies * sizeof(float) * wavelengths : 0));
    return bytes;
}

void refuse_if_too_large(double patches, int wavelengths, FormFactorMethod const* method, int fineness,
                         double allowed_bytes, bool mirrors) {
    double const bytes = memory_needed(patches, wavelengths, method, fineness, mirrors);
    constexpr double most = 1 << 30;  // patches are counted by int, their sides twice
    if (bytes <= allowed_bytes && patches < most) return;
    throw InputError(
        {}, "--size",
        fmt::format("about {:.3g} patches with form factors by {} would take {:.2g} GB; allowed: {:.2g} GB "
                    "(--memory){}",
                    patches, method ? method->name : "none", bytes * 1e-9, allowed_bytes * 1e-9,
                    method && method->entries ? "; --form-factors hierarchical, --on-demand or a "
                                                "stochastic --solver takes less"
                                              : ""));
}

}  // namespace iride::radiosity
