// SPDX-License-Identifier: Apache-2.0
// A coated surface for the sampling loop: what a stack of thin films reflects and transmits of unpolarised light, at
// each lane's wavelength, by the recursion of thin_film.h in single precision. The amplitude is kept as a quotient,
// r = P / Q, so that no layer divides; a and b are q (s) or q / N^2 (p) above and below a boundary:
//   P <- (a - b) Q + (a + b) e^2 P,   Q <- (a + b) Q + (a - b) e^2 P
// Exact but for rounding, so that no film is too thick or too sharp for a table. [Macleod 2017, ch. 2]
#pragma once

#include <vector>

#include "materials/plane_stack.h"
#include "spectral/spectrum.h"

namespace iride {

inline constexpr std::size_t max_coating_layers = 32;
// Error of R and T where the layers' optical thicknesses, n times thickness, sum up to 10 um. Beyond, the wavelength's
// own rounding shows in the narrowest fringes.
inline constexpr double coating_tolerance = 5e-4;
// Optical thickness of one layer beyond which no light of a lamp is coherent.
inline constexpr double most_optical_thickness_nm = 1e5;

// Layers from outside to inside, in air (n = 1). Unpolarised.
double coated_reflectance(std::span<CoatingLayer const> layers, ComplexIndex const& substrate, double wavelength_nm,
                          double cosine);

struct LanePower {
    Lanes R, T;  // R + T <= 1
};

// The indices of a coating's media at the render's wavelengths.
class CoatingTable {
  public:
    // `outside` is transparent. Throws InputError for a layer thicker than is coherent, unless it absorbs what enters.
    CoatingTable(std::span<CoatingLayer const> layers, ComplexIndex const& substrate, WavelengthGrid const& grid,
                 ComplexIndex const& outside = {});

    // The packet's wavelengths, from the first of the grid [nm]. One register, for the closure's size.
    LaneRegister row_of(Wavelengths const& wavelengths) const {
        return __builtin_convertvector(wavelengths.cell, LaneRegister) + wavelengths.fraction;
    }
    // For light from outside, or from inside, which then is transparent; cosine there, in [0, 1]; below it, or NaN,
    // as 0.
    LanePower power(LaneRegister row, float cosine, bool from_inside = false) const;
    Lanes reflectance(LaneRegister row, float cosine) const { return power(row, cosine).R; }
    // 2 int R mu dmu from outside, to 1e-3, at a wavelength that many nanometres from the grid's first.
    double mean_reflectance(double nm) const;

    PlaneStack const& stack() const { return stack_; }

  private:
    struct Medium {
        Reflectance re, im;  // of N^2
        float thickness_nm;  // of a layer
    };

    PlaneStack stack_;
    std::vector<Medium> media_;  // from outside to inside
    float first_nm_;
    int last_cell_;
};

// The Fresnel term of a coated conductor at the packet's wavelengths.
struct CoatedFresnel {
    CoatingTable const* table;  // of the material, which outlives every path
    LaneRegister row;

    Lanes operator()(float cosine) const { return table->reflectance(row, cosine); }
};

}  // namespace iride
