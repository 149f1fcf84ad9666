// SPDX-License-Identifier: Apache-2.0
// Colour differences between two L*a*b* colours: CIE 1976, CIE 1994, CMC(l:c), CIEDE2000.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "colour/lab.h"

namespace iride {

// Euclidean distance. [ISO/CIE 11664-4]
double delta_e_1976(Lab const& a, Lab const& b);

// CIE 1994: Delta L / (kL), Delta C / (1 + K1 C), Delta H / (1 + K2 C), with C of the first colour, which is the
// standard (so it is not symmetric). [CIE 15:2018, 8.2.2]
struct Cie1994Weights {
    double kL, K1, K2;
};
inline constexpr Cie1994Weights graphic_arts{1, 0.045, 0.015}, textiles{2, 0.048, 0.014};
double delta_e_1994(Lab const& standard, Lab const& sample, Cie1994Weights const& weights = graphic_arts);

// CMC(l:c); the first colour is the standard. 2:1 for acceptability, 1:1 for perceptibility. [Clarke 1984]
double delta_e_cmc(Lab const& standard, Lab const& sample, double l = 2, double c = 1);

// CIEDE2000 with kL = kC = kH = 1. [ISO/CIE 11664-6] [Sharma 2005]
double delta_e_2000(Lab const& a, Lab const& b);

// By name, as the command line calls them: cie1976, cie1994 (graphic arts), cie1994-textiles, cmc (2:1), cmc-1:1,
// cie2000. Throws InputError for another.
struct DifferenceFormula {
    std::string_view name, summary;
    double (*of)(Lab const&, Lab const&);
};
std::span<DifferenceFormula const> difference_formulas();
DifferenceFormula const& difference_formula(std::string const& name);

}  // namespace iride
