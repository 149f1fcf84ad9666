// SPDX-License-Identifier: Apache-2.0
// What colours there are: those of lights (the cone over the spectral locus), of objects under an illuminant (the
// Roesch-MacAdam solid), of a monitor (the cube of its linear RGB); and the nearest colour of a monitor.
#pragma once

#include "base/vector.h"
#include "colour/lab.h"
#include "colour/spectral_locus.h"
#include "colour/tristimulus.h"

namespace iride {

// Whether some light has this XYZ: black, or Y > 0 and a chromaticity within the locus.
bool is_light(Xyz const& colour, SpectralLocus const& locus);

// Optimal colours: XYZ of the object that reflects all from `from_nm` to `to_nm` and nothing else, or, with from > to,
// nothing between and all else. They bound the colours of objects under the weights' illuminant. [MacAdam 1935]
Xyz optimal_colour(double from_nm, double to_nm, TristimulusWeights const& weights);

// Whether some reflectance 0 .. 1 has this XYZ (Y = 1 for the perfect diffuser), to 1e-6 of the white. The solid is
// convex and symmetric about the middle grey g; c = g + p is in it if for every d with d.p = 1: sum of |d.weight| / 2
// >= 1.
bool is_object_colour(Xyz const& colour, TristimulusWeights const& weights);

// The colours of linear RGB within 0 .. 1 by a matrix to XYZ.
class RgbGamut {
  public:
    // Throws InputError for a singular matrix.
    explicit RgbGamut(MatrixDouble const& rgb_to_xyz);

    // To a tolerance of 1e-9 in each channel: rounding of the matrix product.
    bool contains(Xyz const& colour) const;

    // Nearest at constant lightness and hue of L*a*b*: chroma is reduced as little as possible; L* is first brought
    // into the range of the gamut's greys.
    Xyz nearest_by_chroma(Xyz const& colour, Xyz const& white) const;

    // Nearest by CIE 1976 difference, over the whole gamut; found to 1e-4 of a unit on the surface of the cube.
    Xyz nearest_by_difference(Xyz const& colour, Xyz const& white) const;

  private:
    Xyz at(VectorDouble const& rgb) const { return to_xyz(VectorDouble(to_xyz_ * rgb)); }

    MatrixDouble to_xyz_, from_xyz_;
};

}  // namespace iride
