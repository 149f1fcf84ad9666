// SPDX-License-Identifier: Apache-2.0
// A function of wavelength as it is described: a constant, a table, a blackbody, a formula. Evaluated in
// double at load time and in colorimetry; the sampling loop uses its tabulated form, Spectrum<D>.
#pragma once

#include <string>
#include <variant>
#include <vector>

namespace iride {

// A closed interval of vacuum wavelengths [nm].
struct WavelengthRange {
    double min_nm, max_nm;

    double width() const { return max_nm - min_nm; }
    bool contains(WavelengthRange const& inner) const { return min_nm <= inner.min_nm && inner.max_nm <= max_nm; }
    friend bool operator==(WavelengthRange const&, WavelengthRange const&) = default;
};

inline constexpr WavelengthRange visible_range{360, 830};  // the domain of the CIE 1931 observer

// What a description means where it says nothing.
enum class Outside {
    error,        // an index of refraction: the loader refuses a range that is not covered
    hold,         // a reflectance: its end value
    zero,         // an emission: dark
    extrapolate,  // on request: the formula, or the line through the last two points of the table, goes on
};

struct ConstantShape {
    double value;
};

// How colorimetry sums a table: by linear interpolation to whole nanometres, or at its own wavelengths alone, which is
// how CIE arrives at the published chromaticities of what it tabulates at 5 nm with lines or steps (C, FL, HP, LED).
enum class Summation { interpolated, tabulated };

// Piecewise linear through (nm[i], value[i]), nm strictly increasing; or, with `step`, constant value[i] on
// [nm[i], nm[i+1]) with nm holding one entry more than value.
struct TabulatedShape {
    std::vector<double> nm, value;
    bool step = false;
    Summation summation = Summation::interpolated;
};

// Planck's law, spectral radiance [W m^-2 sr^-1 nm^-1], exact SI constants, index of the medium 1.
struct BlackbodyShape {
    double temperature_K;
};

// n(lambda) from coefficients, lambda in micrometres; the formulas are those of data/README.md.
struct DispersionShape {
    enum class Formula { sellmeier_squared, sellmeier, general };
    Formula formula;
    std::vector<double> coefficients;
    WavelengthRange valid;
};

// A smooth value in [0, 1]: 1/2 + x / (2 sqrt(1 + x^2)), x = (a t + b) t + c, t = -1 .. 1 over `visible_range`, the
// wavelengths it was fitted to (it is an RGB's spectrum). [Jakob 2019, eqs. 4 and 5]
struct SigmoidShape {
    double a, b, c;
};

using SpectrumShape = std::variant<ConstantShape, TabulatedShape, BlackbodyShape, DispersionShape, SigmoidShape>;

class SpectralFunction {
  public:
    SpectralFunction(SpectrumShape shape, Outside outside, std::string name = {});
    static SpectralFunction constant(double value) { return {ConstantShape{value}, Outside::hold}; }

    // Value at a vacuum wavelength [nm], in the unit of the quantity described.
    double at(double wavelength_nm) const;

    // Where the description itself speaks; (0, infinity) for constants and blackbodies, `visible_range` for a sigmoid.
    WavelengthRange defined_on() const;

    // Largest and smallest value over a range: at the ends, the knots inside and, for formulas, every nm.
    double largest(WavelengthRange const& range) const;
    double smallest(WavelengthRange const& range) const;

    // Integral over `range` of this times `weight` [unit nm]: two-point Gauss rule between every integer nm and every
    // knot of either, so exact for the product of two piecewise linear functions.
    double integral(WavelengthRange const& range, SpectralFunction const& weight = constant(1)) const;

    SpectralFunction scaled(double factor) const;
    SpectralFunction with_outside(Outside outside) const;
    bool is_constant() const { return std::holds_alternative<ConstantShape>(shape_); }

    SpectrumShape const& shape() const { return shape_; }
    Outside outside() const { return outside_; }
    std::string const& name() const { return name_; }

  private:
    std::vector<double> knots(WavelengthRange const& range) const;

    SpectrumShape shape_;
    double scale_ = 1;
    Outside outside_;
    std::string name_;
};

// What a sigmoid says at any wavelength [nm], inside visible_range or not.
double sigmoid_value(SigmoidShape const& shape, double wavelength_nm);

inline constexpr double planck_constant = 6.62607015e-34;   // J s, exact, SI 2019
inline constexpr double speed_of_light = 299792458;         // m/s, exact
inline constexpr double boltzmann_constant = 1.380649e-23;  // J/K, exact, SI 2019
inline constexpr double second_radiation_constant =         // c2 = h c / k [m K]
    planck_constant * speed_of_light / boltzmann_constant;

// Planck's law [W m^-2 sr^-1 nm^-1]: c1L / lambda^5 / (exp(c2 / (lambda T)) - 1), c1L = 2 h c^2.
double planck_radiance(double wavelength_nm, double temperature_K);

}  // namespace iride
