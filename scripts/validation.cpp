// SPDX-License-Identifier: Apache-2.0
// Prints docs/validation.md (scripts/validation writes it): each law with its reference, tolerance, test, and the error
// that this build has, computed here.
#include <fmt/format.h>

#include <cmath>

#include "colour/cie_space.h"
#include "colour/config_check.h"
#include "colour/description.h"
#include "colour/illuminant.h"
#include "colour/rgb_encoding.h"
#include "colour/rgb_to_spectrum.h"
#include "support/colorchecker.h"
#include "support/eye.h"
#include "support/sharma.h"

namespace iride {

namespace {

struct Row {
    std::string law, formula, reference;
    double tolerance;
    std::string unit, test;
    double error;
};

Chromaticity seen(char const* light, char const* eye) {
    return to_chromaticity(xyz_of_light(illuminant(light), observer(eye)));
}

double distance(Chromaticity const& a, Chromaticity const& b) {
    return std::max(std::abs(a.x - b.x), std::abs(a.y - b.y));
}

double white_points() {
    double most = distance(seen("D65", "cie1964_10deg"), {.31382, .33100});
    for (auto const& [name, published] : {std::pair{"A", Chromaticity{.44758, .40745}},
                                          {"C", {.31006, .31616}},
                                          {"D50", {.34567, .35851}},
                                          {"D55", {.33243, .34744}},
                                          {"D65", {.31272, .32903}},
                                          {"D75", {.29903, .31488}}})
        most = std::max(most, distance(seen(name, "cie1931_2deg"), published));
    return most;
}

double ybar_sum() {
    double sum = 0;
    for (int nm = 360; nm <= 830; ++nm) sum += cie1931_2deg().at(nm).Y;
    return std::abs(sum - 106.8569171);
}

double luv_triple() {
    auto const luv = to_luv({.20654008, .12197225, .05136952}, to_xyz(Chromaticity{.3127, .3290}, 1));
    return std::max({std::abs(luv.L - 41.52787529), std::abs(luv.u - 96.83626054), std::abs(luv.v - 17.75210149)});
}

double sharma() {
    double most = 0;
    for (test::LabPair const& pair : test::sharma_pairs)
        most = std::max(most, std::abs(delta_e_2000(pair.p, pair.q) - pair.difference));
    return most;
}

// Over mixtures of each monochromatic stimulus with white.
double cie_round_trip() {
    Xyz const white = to_xyz(named_white("D65"), 1);
    double most = 0;
    for (CieSpace const& space : cie_spaces())
        for (double nm = 380; nm <= 780; nm += 5)
            for (double share = 0; share < 1; share += 0.1) {
                Xyz const c = share * cie1931_2deg().at(nm) + (1 - share) * white;
                Xyz const back = space.to_xyz(space.from_xyz(c, white), white);
                most = std::max(
                    most, (to_vector(back) - to_vector(c)).cwiseAbs().maxCoeff() / to_vector(c).cwiseAbs().maxCoeff());
            }
    return most;
}

double rgb_round_trip() {
    double most = 0;
    for (RgbEncoding const& from : rgb_encodings())
        for (RgbEncoding const& to : rgb_encodings())
            for (double t = 0.05; t <= 1; t += 0.05) {
                VectorDouble const c(t, t * t, 1 - t / 2);
                VectorDouble const back = RgbConversion(to, from)(RgbConversion(from, to)(c));
                most = std::max(most, (back - c).cwiseAbs().maxCoeff());
            }
    return most;
}

double correlated_temperature() {
    PlanckianLocus const locus(cie1931_2deg());
    double most = 0;
    for (double T = 1010; T < 99000; T *= 1.05) {
        auto const found = locus.nearest(to_uv_1960(to_uv_prime(xyz_of_light(blackbody(T), cie1931_2deg()))));
        most = std::max(most, found ? std::abs(found->cct_K - T) : T);
    }
    return most;
}

double uplift() {
    test::Eye const eye(white_light(rgb::rec709.white));
    constexpr int side = 32;
    double most = 0;
    for (int i = 0; i < side * side * side; ++i) {
        Eigen::Vector3d const rgb = Eigen::Vector3d(i % side, i / side % side, i / side / side).unaryExpr([](double v) {
            return decode(TransferFunction::srgb, v / (side - 1));
        });
        SpectralFunction const s = rgb_to_spectrum(rgb, rgb::rec709, RgbRole::reflectance);
        most = std::max(most, test::difference_1976(eye.ratio(s), test::wanted_ratio(rgb::rec709, rgb)));
    }
    return most;
}

double ocio() {
    double most = 0;
    for (SpaceCheck const& s : check_config(ColourConfig(data_folder() / "ocio" / "config.ocio")).spaces)
        most = std::max({most, s.delta_e_2000_max, s.round_trip_delta_e_2000_max});
    return most;
}

double table_against_formula(SpectralFunction const& table, SpectralFunction const& formula, bool relative) {
    double most = 0;
    for (int nm = 300; nm <= 780; nm += 5)
        most = std::max(most, std::abs(formula.at(nm) - table.at(nm)) / (relative ? table.at(nm) : 1));
    return most;
}

double daylight() {
    return std::max(
        {table_against_formula(illuminant("D50"), daylight_illuminant(d50_temperature.on_scale_of(c2_its90)), false),
         table_against_formula(illuminant("D55"), daylight_illuminant(d55_temperature.on_scale_of(c2_its90)), false),
         table_against_formula(illuminant("D75"), daylight_illuminant(d75_temperature.on_scale_of(c2_its90)), false)});
}

std::vector<Row> colour_rows() {
    return {
        {"White points of A, C, D50, D55, D65, D75, and of D65 at 10 degrees", "x, y of sums at 1 nm", "CIE 15:2018",
         5e-5, "", "white points are those of CIE 15 to 5e-5", white_points()},
        {"White point of E", "x, y of sums at 1 nm", "ISO/CIE 11664-1, tables at 1 nm", 5e-7, "",
         "white points are those of CIE 15 to 5e-5", distance(seen("E", "cie1931_2deg"), {.333314, .333288})},
        {"White point of FL2", "x, y of sums at 5 nm", "CIE 15:2018, summed as tabulated", 5e-6, "",
         "lamps with lines are summed at their own 5 nm", distance(seen("FL2", "cie1931_2deg"), {.37207, .37512})},
        {"Sum of the 1931 ybar", "sum at 1 nm", "ISO/CIE 11664-1", 5e-8, "",
         "the matching functions sum to the CIE's figures", ybar_sum()},
        {"D50, D55, D75", "S0 + M1 S1 + M2 S2", "CIE 15:2018, tables at 5 nm", .0051, "",
         "the tables of the D series are the formula at their temperature", daylight()},
        {"Illuminant A", "Planck's law, T = 2848 c2 / 0.01435", "ISO/CIE 11664-2, table at 5 nm", 1e-5, "relative",
         "illuminant A is Planck's law with the c2 of its definition",
         table_against_formula(illuminant("A"), illuminant_a(), true)},
        {"L*u*v* of a printed colour", "CIE 1976 L*u*v*", "ISO/CIE 11664-5", 1e-7, "", "L*u*v* is the published triple",
         luv_triple()},
        {"CIEDE2000 of 34 pairs", "CIEDE2000", "Sharma, Wu, Dalal 2005, table 1", 1e-4, "",
         "CIEDE2000 is right on all 34 pairs of Sharma, Wu and Dalal", sharma()},
        {"XYZ to every CIE space and back", "each space's definition", "identity", 1e-12, "relative",
         "every CIE space brings the spectral solid back", cie_round_trip()},
        {"Every RGB space to every other and back", "decode, matrix, encode", "identity", 1e-12, "",
         "converting to any RGB space and back is the identity to 1e-12", rgb_round_trip()},
        {"Correlated temperature of blackbodies, 1000 to 100000 K", "nearest point in u, v (1960)", "Planck's law", 1,
         "K", "correlated temperature and Duv are found to 1e-3 K from 1000 to 100000 K", correlated_temperature()},
        {"Reflectance of sRGB, grid of 32 x 32 x 32", "smooth sigmoid, CIE 1976 difference", "the RGB's own XYZ", .002,
         "", "a 32 x 32 x 32 grid of sRGB comes back within a CIE 1976 difference of .002", uplift()},
        {"Spaces of the shipped OpenColorIO config, there and back", "CIEDE2000", "formulas of the standards, double",
         tolerable_delta_e, "", "the shipped config is right in every space it has", ocio()},
    };
}

std::vector<Row> checker_rows() {
    std::vector<Row> rows;
    constexpr int side = 48, spp = 1024;
    for (char const* lamp : {"D65", "A", "FL2"})
        rows.push_back(
            {fmt::format("24 ColorChecker patches rendered under {}, {} spp", lamp, spp), "CIEDE2000",
             "direct integration of the tables", .02, "",
             "24 ColorChecker patches rendered under D65, A and FL2 are within CIEDE2000 .02 of direct integration",
             test::checker_errors(lamp, side, spp).rendered});
    return rows;
}

void print(std::vector<Row> const& rows) {
    for (Row const& r : rows)
        fmt::print("| {} | {} | {} | {:g}{} | {:.2g} | {} |\n", r.law, r.formula, r.reference, r.tolerance,
                   r.unit.empty() ? "" : " " + r.unit, r.error, r.test);
}

}  // namespace

}  // namespace iride

int main() {
    fmt::print(
        "# Validation\n\n"
        "What is checked against a reference, how closely it must agree, and how closely this version does: the "
        "largest\n"
        "error over everything the law names. Written by `scripts/validation`, which computes every error anew; the "
        "tests\n"
        "named in the last column assert the tolerances (some assert a closer one).\n\n"
        "| law | formula | reference | tolerance | error | test |\n|---|---|---|---|---|---|\n");
    iride::print(iride::colour_rows());
    iride::print(iride::checker_rows());
}
