// SPDX-License-Identifier: Apache-2.0
// What surfaces send on of light that came from no lamp, gathered once more where the camera looks: at vertices, by N
// rays by the cosine that ask the patches they meet,
//   b_v = rho_i (1/N) sum over rays of b_j;
// elements are split while what their middle sends on is not the mean of their corners'. A patch's own value is a mean
// over it, and misses what falls within its width. Where a ray meets a patch nearer than the patch is wide, that mean
// is not asked either, but a lamp from the place met: else light that lies behind a window's frame would shine through
// it, on a patch that comes out on both sides. [Reichert 1992] [Lischinski 1993] [Ward 1988]
#pragma once

#include <functional>
#include <memory>

#include "integrators/radiosity/field.h"
#include "integrators/radiosity/lamp_light.h"

namespace iride::radiosity {

// How many camera rays meet each patch.
using Seen = std::function<std::vector<int>(PatchTracer const&, std::size_t patches)>;

// A solution, [patch][wavelength] of `mesh`.
struct Solved {
    PatchMesh const& mesh;
    PatchTracer const& tracer;
    std::vector<double> const& wavelengths_nm;
    Spectra reflectance, reflected, indirect;  // of what is reflected, what came from no lamp
};

struct LastGather {
    int rays;             // N of a vertex that fills a few pixels; more and fewer with the root of their number
    double memory_bytes;  // splitting ends before elements take more
};

// Where the camera does not look, the field is that of `indirect`. Adds to `remarks` what the user is to be told.
std::shared_ptr<RadiosityField const> gathered_where_seen(Solved const& solved, LampLight const& lamps,
                                                          Seen const& seen_in, LastGather const& settings,
                                                          std::vector<std::string>& remarks);

}  // namespace iride::radiosity
