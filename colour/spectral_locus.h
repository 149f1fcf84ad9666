// SPDX-License-Identifier: Apache-2.0
// The spectral locus of an observer: chromaticities of the monochromatic stimuli at 1 nm, closed by the line of
// purples. Between tabulated wavelengths the matching functions are linear, so the chromaticity moves on a straight
// line, and a point of the polygon has exactly one wavelength. [CIE 15:2018, 9.2]
#pragma once

#include <optional>
#include <vector>

#include "colour/observer.h"

namespace iride {

class SpectralLocus {
  public:
    // Where a ray leaves the locus; no wavelength on the line of purples.
    struct Crossing {
        Chromaticity at;
        std::optional<double> wavelength_nm;
        double distance;  // from the ray's origin
    };

    explicit SpectralLocus(Observer const& observer);

    // Inside the locus or on it.
    bool contains(Chromaticity const& c) const;

    // From a point inside, in direction (dx, dy), not zero.
    Crossing crossing(Chromaticity const& from, double dx, double dy) const;

    // Its vertices from violet to red, at 1 nm, up to where rounding turns the ends of the tables back on themselves.
    std::vector<Chromaticity> const& points() const { return point_; }
    std::vector<double> const& wavelengths_nm() const { return nm_; }

  private:
    std::vector<Chromaticity> point_;
    std::vector<double> nm_, sum_;  // sum_: xbar + ybar + zbar, the weight of a point in a mixture
};

struct DominantWavelength {
    std::optional<double> dominant_nm;       // absent for purples and for the white itself
    std::optional<double> complementary_nm;  // absent where the line of purples lies opposite, and for the white itself
    double excitation_purity;                // 0 at the white, 1 on the locus or the line of purples
};

// Of a chromaticity against a white inside the locus, else InputError. [CIE 15:2018, 9.2 - 9.4]
DominantWavelength dominant_wavelength(Chromaticity const& colour, Chromaticity const& white,
                                       SpectralLocus const& locus);

}  // namespace iride
