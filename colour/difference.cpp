// SPDX-License-Identifier: Apache-2.0
#include "colour/difference.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "base/diagnostics.h"
#include "base/vector.h"
#include "colour/lch.h"

namespace iride {

namespace {

// Differences in lightness, chroma and (squared: its sign is not needed) hue.
struct Parts {
    double L, C, H2;
};
Parts parts(Lab const& p, Lab const& q) {
    double const C = std::hypot(q.a, q.b) - std::hypot(p.a, p.b);
    return {q.L - p.L, C, std::max(0.0, square(q.a - p.a) + square(q.b - p.b) - square(C))};
}

double cos_deg(double degrees) { return std::cos(radians(degrees)); }
double seventh_power_ratio(double chroma) {
    constexpr double c25 = 6103515625.0;  // 25^7
    double const c7 = std::pow(chroma, 7);
    return std::sqrt(c7 / (c7 + c25));
}

constexpr std::array formulas{
    DifferenceFormula{"cie1976", "Euclidean distance in L*a*b*", delta_e_1976},
    DifferenceFormula{"cie1994", "CIE 1994, graphic arts",
                      [](Lab const& p, Lab const& q) { return delta_e_1994(p, q, graphic_arts); }},
    DifferenceFormula{"cie1994-textiles", "CIE 1994, textiles",
                      [](Lab const& p, Lab const& q) { return delta_e_1994(p, q, textiles); }},
    DifferenceFormula{"cmc", "CMC(2:1), acceptability",
                      [](Lab const& p, Lab const& q) { return delta_e_cmc(p, q, 2, 1); }},
    DifferenceFormula{"cmc-1:1", "CMC(1:1), perceptibility",
                      [](Lab const& p, Lab const& q) { return delta_e_cmc(p, q, 1, 1); }},
    DifferenceFormula{"cie2000", "CIEDE2000", delta_e_2000}};

}  // namespace

double delta_e_1976(Lab const& p, Lab const& q) {
    return std::sqrt(square(p.L - q.L) + square(p.a - q.a) + square(p.b - q.b));
}

double delta_e_1994(Lab const& p, Lab const& q, Cie1994Weights const& k) {
    Parts const d = parts(p, q);
    double const C = std::hypot(p.a, p.b);
    return std::sqrt(square(d.L / k.kL) + square(d.C / (1 + k.K1 * C)) + d.H2 / square(1 + k.K2 * C));
}

double delta_e_cmc(Lab const& p, Lab const& q, double l, double c) {
    Parts const d = parts(p, q);
    double const C = std::hypot(p.a, p.b), h = hue_deg(p.a, p.b);
    double const SL = p.L < 16 ? 0.511 : 0.040975 * p.L / (1 + 0.01765 * p.L);
    double const SC = 0.0638 * C / (1 + 0.0131 * C) + 0.638;
    double const T =
        164 <= h && h <= 345 ? 0.56 + std::abs(0.2 * cos_deg(h + 168)) : 0.36 + std::abs(0.4 * cos_deg(h + 35));
    double const F = std::sqrt(std::pow(C, 4) / (std::pow(C, 4) + 1900));
    double const SH = SC * (F * T + 1 - F);
    return std::sqrt(square(d.L / (l * SL)) + square(d.C / (c * SC)) + d.H2 / square(SH));
}

double delta_e_2000(Lab const& p, Lab const& q) {
    double const g = 0.5 * (1 - seventh_power_ratio((std::hypot(p.a, p.b) + std::hypot(q.a, q.b)) / 2));
    double const a1 = (1 + g) * p.a, a2 = (1 + g) * q.a;
    double const C1 = std::hypot(a1, p.b), C2 = std::hypot(a2, q.b);
    double const h1 = hue_deg(a1, p.b), h2 = hue_deg(a2, q.b);
    bool const neutral = C1 * C2 == 0;
    double dh = neutral ? 0 : h2 - h1;
    if (dh > 180) dh -= 360;
    if (dh < -180) dh += 360;
    double const dL = q.L - p.L, dC = C2 - C1, dH = 2 * std::sqrt(C1 * C2) * std::sin(radians(dh / 2));
    double const L = (p.L + q.L) / 2, C = (C1 + C2) / 2;
    double h = neutral ? h1 + h2 : (h1 + h2) / 2;
    if (!neutral && std::abs(h1 - h2) > 180) h += h1 + h2 < 360 ? 180 : -180;
    double const T =
        1 - 0.17 * cos_deg(h - 30) + 0.24 * cos_deg(2 * h) + 0.32 * cos_deg(3 * h + 6) - 0.20 * cos_deg(4 * h - 63);
    double const SL = 1 + 0.015 * square(L - 50) / std::sqrt(20 + square(L - 50));
    double const SC = 1 + 0.045 * C, SH = 1 + 0.015 * C * T;
    double const turn = 30 * std::exp(-square((h - 275) / 25));
    double const RT = -2 * seventh_power_ratio(C) * std::sin(radians(2 * turn));
    double const l = dL / SL, c = dC / SC, s = dH / SH;
    return std::sqrt(std::max(0.0, l * l + c * c + s * s + RT * c * s));
}

std::span<DifferenceFormula const> difference_formulas() { return formulas; }

DifferenceFormula const& difference_formula(std::string const& name) {
    std::vector<std::string> names;
    for (DifferenceFormula const& formula : formulas) {
        if (formula.name == name) return formula;
        names.emplace_back(formula.name);
    }
    throw InputError({}, "formula", fmt::format("unknown difference formula '{}'{}", name, suggestion(name, names)));
}

}  // namespace iride
