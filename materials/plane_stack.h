// SPDX-License-Identifier: Apache-2.0
// A plane surface as wave optics sees it, at any wavelength: the medium outside, thin films from outside to inside, the
// substance below. In double precision, for load time and for `iride material`; the sampling loop has its own forms.
// [Born 1999, secs. 1.5, 1.6 and 14.2]
#pragma once

#include <vector>

#include "materials/thin_film.h"
#include "spectral/complex_index.h"

namespace iride {

struct CoatingLayer {
    ComplexIndex index;
    double thickness_nm;
};

// n + ik at a wavelength [nm]; k >= 0.
std::complex<double> index_at(ComplexIndex const& index, double wavelength_nm);

struct PlaneStack {
    ComplexIndex outside{};  // transparent: its k is not read
    std::vector<CoatingLayer> layers{};
    ComplexIndex inside{};

    // Of power, for light that arrives from outside; cosine there, in [0, 1]. T is what enters an absorbing substance.
    StackPower<double> power(double wavelength_nm, double cosine) const;
    // The same surface for light from inside, which must be transparent.
    PlaneStack seen_from_inside() const { return {inside, {layers.rbegin(), layers.rend()}, outside}; }

    // Where every index is given.
    WavelengthRange defined_on() const;
};

}  // namespace iride
