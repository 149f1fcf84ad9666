// SPDX-License-Identifier: Apache-2.0
// A standard observer: three colour-matching functions. XYZ of a spectral radiance L is
//   X = (integral of L xbar) / (integral of ybar), and so on, over the observer's whole domain.
#pragma once

#include <string>
#include <vector>

#include "colour/xyz.h"
#include "spectral/spectral_function.h"

namespace iride {

struct Observer {
    std::string name;
    SpectralFunction xbar, ybar, zbar;  // zero outside their table
    double ybar_integral;               // [nm], over the table's domain

    Xyz at(double wavelength_nm) const {
        return {xbar.at(wavelength_nm), ybar.at(wavelength_nm), zbar.at(wavelength_nm)};
    }
    // XYZ of a spectral radiance, by exact integration of the two piecewise linear functions.
    Xyz integrate(SpectralFunction const& radiance) const;
};

// By name, one of observer_names(): "cie1931_2deg", "cie1964_10deg" [ISO/CIE 11664-1], "cie2015_2deg", "cie2015_10deg"
// [CIE 170-2]. Throws InputError for an unknown one. Read once, kept for the program's life.
Observer const& observer(std::string const& name);
std::vector<std::string> const& observer_names();
inline Observer const& cie1931_2deg() { return observer("cie1931_2deg"); }

// The factor that makes (integral of L ybar) / (integral of ybar) equal to `luminance`.
SpectralFunction luminance_weighted(SpectralFunction const& radiance, double luminance, Observer const& observer);

// K_m of ISO/CIE 23539, rounded as CIE does [lm/W].
inline constexpr double maximum_luminous_efficacy = 683;

// Luminance of Y = 1 in cd m^-2: K_m times the integral of ybar.
double luminance_of_unit_Y(Observer const& observer);

}  // namespace iride
