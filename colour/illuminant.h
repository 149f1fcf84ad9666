// SPDX-License-Identifier: Apache-2.0
// CIE illuminants: those of the tables, the D series at any correlated colour temperature, blackbodies.
//   D series: S = S0 + M1 S1 + M2 S2, M1 and M2 (to three decimals) from the chromaticity x_D(T), y_D(x_D).
// The temperature in an illuminant's name belongs to the c2 of its definition; on today's scale it is T c2 / c2_then.
// [CIE 15:2018, 4.1.2] [ISO/CIE 11664-2]
#pragma once

#include <filesystem>
#include <string>

#include "colour/xyz.h"
#include "spectral/spectral_function.h"

namespace iride {

// A temperature as a definition names it, with the second radiation constant of that time.
struct DefinedTemperature {
    double nominal_K, c2_m_K;

    // The same radiator with the c2 of today.
    double on_scale_of(double c2_today_m_K) const { return nominal_K * (c2_today_m_K / c2_m_K); }
};
inline constexpr double c2_its90 = 1.4388e-2;  // m K; what CIE 15 uses for the D series
inline constexpr DefinedTemperature illuminant_a_temperature{2848, 1.4350e-2}, d50_temperature{5000, 1.4380e-2},
    d55_temperature{5500, 1.4380e-2}, d65_temperature{6500, 1.4380e-2}, d75_temperature{7500, 1.4380e-2};

// Chromaticity of the D series, 4000 .. 25000 K, else InputError.
Chromaticity daylight_chromaticity(double cct_K);

// Relative spectral power of the D series, 300 .. 830 nm, near 100 at 560 nm. Throws InputError outside 4000 .. 25000
// K.
SpectralFunction daylight_illuminant(double cct_K);

// Illuminant A as its formula defines it: Planck's law at its temperature, 100 at 560 nm.
SpectralFunction illuminant_a();

// A blackbody [W m^-2 sr^-1 nm^-1]. Throws InputError unless 0 < T <= 1e8 K.
SpectralFunction blackbody(double temperature_K);

// By name: a table of the catalogue ("A", "D65", "FL2", "HP1", "LED-B1", ...), "daylight:5200", "blackbody:2700"
// (kelvin), or a file ("lamp.csv", "lamp.csv:column"). Throws InputError: unknown, not a spectral power, negative.
SpectralFunction illuminant(std::string const& name, std::filesystem::path const& folder = {});

}  // namespace iride
