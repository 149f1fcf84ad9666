// SPDX-License-Identifier: Apache-2.0
// Interpolation of equally spaced spectral tables as CIE and ASTM recommend it: Sprague's fifth-order polynomial, and
// Lagrange's weights. [CIE 15:2018, 7.2.1.2] [CIE 167:2005] [ASTM E2022]
#pragma once

#include <array>

#include "spectral/spectral_function.h"

namespace iride {

// The same table at every whole nanometre of its range by Sprague's polynomial, whose first and second derivative are
// continuous at the knots. Throws InputError unless it is a table of six or more values at equal steps.
SpectralFunction sprague_interpolated(SpectralFunction const& table);

// Lagrange's weights of points 0, 1, 2 (and 3) at place x [steps]: they sum to 1 and reproduce a quadratic (a cubic).
std::array<double, 3> lagrange_quadratic(double x);
std::array<double, 4> lagrange_cubic(double x);

// The step of a table if its wavelengths are equally spaced (to a thousandth of it), else 0.
double equal_step(std::vector<double> const& nm);

}  // namespace iride
