// SPDX-License-Identifier: Apache-2.0
// Tristimulus integration as CIE practises it: sums at 1 nm,
//   X = k sum of S(lambda) R(lambda) xbar(lambda), and so on,
// with k = 1 / sum of S ybar for an object under illuminant S (Y = 1 for the perfect diffuser), k = 1 / sum of ybar for
// a light (R = 1; Y = 1 for 1 W m^-2 sr^-1 nm^-1 at every wavelength). Multiply by 100 for the scale of CIE 15. Tables
// are interpolated linearly to whole nanometres within the observer's domain (wish for Sprague? sprague_interpolated
// first); a table with Summation::tabulated is summed at its own wavelengths; one finer than 1 nm keeps its own points
// too. Outside its table a spectrum is what its Outside says. [CIE 15:2018, 7] [ASTM E308]
#pragma once

#include <span>
#include <vector>

#include "colour/observer.h"

namespace iride {

// XYZ of a light. Throws InputError if its Y is 0, it is negative somewhere, or not finite.
Xyz xyz_of_light(SpectralFunction const& radiance, Observer const& observer);

// Luminance [cd m^-2] of a spectral radiance [W m^-2 sr^-1 nm^-1], and so lumen of watts: K_m times the sum of L ybar.
double luminance_of(SpectralFunction const& radiance, Observer const& observer);

// The sums for objects under one illuminant, made once. Applying them is three dot products.
class TristimulusWeights {
  public:
    // Throws InputError as xyz_of_light does.
    TristimulusWeights(SpectralFunction const& illuminant, Observer const& observer);

    // XYZ of a reflectance factor or transmittance 0 .. 1; Y = 1 for the perfect diffuser.
    Xyz of(SpectralFunction const& factor) const;
    // The same from the factor's values at wavelengths_nm(), in that order.
    Xyz of(std::span<double const> factor) const;

    // The same by at_steps for a table at equal steps of 5, 10 or 20 nm, whose points lie apart so far that straight
    // lines between them cost colour (24 ColorChecker patches at 5 nm: up to .04 of CIEDE2000); other shapes as `of`.
    Xyz of_measured(SpectralFunction const& factor) const;

    Xyz white() const { return white_; }  // of the perfect diffuser: the illuminant's colour with Y = 1
    std::vector<double> const& wavelengths_nm() const { return nm_; }
    std::vector<Xyz> const& weights() const { return weight_; }  // at wavelengths_nm()

    // Weights for a factor measured at first, first + step, ... last only: those that interpolate it by Lagrange's
    // cubic (quadratic in the outermost intervals), hold its end values beyond, and sum as above. No correction for the
    // instrument's bandpass. Throws InputError for fewer than 3 points. [ASTM E2022]
    TristimulusWeights at_steps(double first_nm, double last_nm, double step_nm) const;

  private:
    TristimulusWeights() = default;

    std::vector<double> nm_;
    std::vector<Xyz> weight_;
    Xyz white_;
};

}  // namespace iride
