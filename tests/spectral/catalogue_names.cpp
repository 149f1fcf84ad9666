// SPDX-License-Identifier: Apache-2.0
// Every shipped name gives a spectrum of its quantity, every shipped table says what it is, and the indices are those
// of the data sheets.
#include <catch2/catch.hpp>
#include <fstream>

#include "spectral/catalogue.h"

using namespace iride;
using Catch::Matchers::Contains;

namespace {

std::string content(std::filesystem::path const& path) {
    std::ifstream in(path);
    return {std::istreambuf_iterator<char>(in), {}};
}

// d, F and C: the helium and hydrogen lines by which glasses are ordered [nm].
constexpr double line_d = 587.5618, line_F = 486.1327, line_C = 656.2725;

}  // namespace

TEST_CASE("every catalogue name loads as its quantity and covers some of the visible range", "[unit]") {
    auto const names = [](SpectralQuantity q) { return catalogue_names(q); };
    CHECK(names(SpectralQuantity::power).size() == 49);
    CHECK(names(SpectralQuantity::reflectance).size() == 27);
    CHECK(names(SpectralQuantity::complex_index).size() >= 60);
    for (std::string const& name : names(SpectralQuantity::complex_index)) {
        INFO(name);
        CHECK(in_catalogue(name));
        ComplexIndex const index = load_complex_index(name);
        CHECK(index.n.defined_on().contains({450, 700}));
        CHECK(index.n.smallest({450, 700}) > 0);
        CHECK(index.k.smallest({450, 700}) >= 0);
        CHECK(index.n.outside() == Outside::error);
    }
    for (std::string const& name : names(SpectralQuantity::power)) {
        INFO(name);
        SpectralFunction const light = load_spectrum(name, SpectralQuantity::power);
        CHECK(light.smallest(visible_range) >= 0);
        CHECK(light.integral(visible_range) > 0);
        CHECK(light.at(2000) == 0);  // an emission is zero outside its table
    }
    for (std::string const& name : names(SpectralQuantity::reflectance)) {
        INFO(name);
        SpectralFunction const paint = load_spectrum(name, SpectralQuantity::reflectance);
        CHECK(paint.smallest(visible_range) >= 0);
        CHECK(paint.largest(visible_range) <= 1);
        CHECK(paint.at(2000) == paint.at(paint.defined_on().max_nm));  // a reflectance holds its end value
    }
}

TEST_CASE("short names stand for the usual measurement", "[unit]") {
    for (auto const& [name, full] : std::vector<std::pair<std::string, std::string>>{{"Au", "Au:Johnson"},
                                                                                     {"Ag", "Ag:Johnson"},
                                                                                     {"Cu", "Cu:Johnson"},
                                                                                     {"Al", "Al:Rakic"},
                                                                                     {"Fe", "Fe:Johnson"},
                                                                                     {"Ni", "Ni:Johnson"},
                                                                                     {"Cr", "Cr:Johnson"},
                                                                                     {"Ti", "Ti:Johnson"},
                                                                                     {"Pt", "Pt:Werner"},
                                                                                     {"W", "W:Werner"},
                                                                                     {"brass", "CuZn:Querry-Cu70Zn30"},
                                                                                     {"Cu70Zn30", "brass"},
                                                                                     {"BK7", "N-BK7"},
                                                                                     {"water", "H2O:Daimon-20_0C"},
                                                                                     {"diamond", "C:Peter"}}) {
        INFO(name);
        ComplexIndex const a = load_complex_index(name), b = load_complex_index(full);
        CHECK(a.n.at(555) == b.n.at(555));
        CHECK(a.k.at(555) == b.k.at(555));
    }
    CHECK(load_complex_index("Au").n.at(587.55) != load_complex_index("Au:McPeak").n.at(587.55));
}

// Johnson and Christy's own table: 2.26 eV (548.6 nm) is n + ik = 0.43 + 2.455i, 1.64 eV (756 nm) 0.14 + 4.542i.
TEST_CASE("gold has the n + ik of the paper's rows", "[unit]") {
    ComplexIndex const gold = load_complex_index("Au");
    CHECK(gold.n.at(548.6) == Approx(0.43).epsilon(1e-12));
    CHECK(gold.k.at(548.6) == Approx(2.455).epsilon(1e-12));
    CHECK(gold.n.at(756) == Approx(0.14).epsilon(1e-12));
    CHECK(gold.k.at(756) == Approx(4.542).epsilon(1e-12));
}

// n_d and Abbe numbers of SCHOTT's data sheets. A swap of the two Sellmeier formulas or of L and L^2 fails.
TEST_CASE("glasses have the index and Abbe number of their data sheets", "[law]") {
    struct Row {
        char const* name;
        double nd, abbe;
    };
    for (Row const& r : {Row{"N-BK7", 1.51680, 64.17},
                         {"F2", 1.62004, 36.37},
                         {"N-F2", 1.62005, 36.43},
                         {"SF11", 1.78472, 25.76},
                         {"N-SF11", 1.78472, 25.68},
                         {"N-SK16", 1.62041, 60.32},
                         {"N-BAF10", 1.67003, 47.11},
                         {"LAFN7", 1.74950, 34.95},
                         {"N-LAK33B", 1.75500, 52.30},
                         {"N-FK51A", 1.48656, 84.47}}) {
        INFO(r.name);
        ComplexIndex const glass = load_complex_index(r.name);
        double const nd = glass.n.at(line_d);
        CHECK(nd == Approx(r.nd).margin(1e-5).epsilon(0));
        CHECK((nd - 1) / (glass.n.at(line_F) - glass.n.at(line_C)) == Approx(r.abbe).margin(0.01).epsilon(0));
        CHECK(glass.k.at(line_d) == 0);
    }
}

// Diamond and water: five digits of the published formulas at the d line; silica: Malitson's table; sapphire: Malitson
// and Dodge, ordinary ray; rutile: Devore's table, ordinary and extraordinary ray at 589.3 nm.
TEST_CASE("crystals and water have the published index", "[law]") {
    auto const n = [](char const* name, double nm) { return load_complex_index(name).n.at(nm); };
    CHECK(n("diamond", line_d) == Approx(2.41749).margin(5e-6).epsilon(0));
    CHECK(n("water", line_d) == Approx(1.3334).margin(5e-5).epsilon(0));
    CHECK(n("fused-silica", line_d) == Approx(1.45846).margin(5e-6).epsilon(0));
    CHECK(n("sapphire", 589.3) == Approx(1.768).margin(5e-4).epsilon(0));
    CHECK(n("TiO2:Devore-o", 589.3) == Approx(2.613).margin(5e-4).epsilon(0));
    CHECK(n("TiO2:Devore-e", 589.3) == Approx(2.909).margin(5e-4).epsilon(0));
}

TEST_CASE("unknown names offer the nearest, and a name of another quantity is refused", "[input]") {
    CHECK_THROWS_WITH(load_complex_index("BK77"),
                      Contains("'BK77' is neither a shipped index of refraction nor a file; "
                               "did you mean 'BK7'?"));
    CHECK_THROWS_WITH(load_complex_index("unobtainium"), Contains("data/README.md lists the names"));
    CHECK_THROWS_WITH(load_complex_index("D65"), Contains("'D65' is no index of refraction"));
    CHECK_THROWS_WITH(load_spectrum("D66", SpectralQuantity::power),
                      Contains("neither a shipped spectral power nor a file; did you mean 'D65'?"));
    CHECK_THROWS_WITH(load_spectrum("Au", SpectralQuantity::reflectance), Contains("'Au' is no reflectance"));
    CHECK_THROWS_WITH(load_spectrum("cornell:white", SpectralQuantity::power), Contains("is no spectral power"));
    CHECK_THROWS_WITH(load_spectrum("Au", SpectralQuantity::complex_index), Contains("holds n and k"));
    CHECK(load_spectrum("N-BK7", SpectralQuantity::complex_index).at(line_d) ==
          load_complex_index("N-BK7").n.at(line_d));
}

TEST_CASE("every shipped table names itself, its quantity, unit, source and licence, and stands in the list",
          "[unit]") {
    std::string const list = content(data_folder() / "README.md");
    int tables = 0;
    for (char const* folder : {"cie", "optical", "reflectance"})
        for (auto const& entry : std::filesystem::directory_iterator(data_folder() / folder)) {
            std::string const path = std::string(folder) + "/" + entry.path().filename().string();
            INFO(path);
            std::string const text = content(entry.path());
            for (char const* key : {"# name: ", "# quantity: ", "# unit: ", "# source: ", "# licence: "})
                CHECK_THAT(text, Contains(key));
            CHECK_NOTHROW(read_spectrum_file(entry.path()));
            CHECK_THAT(list, Contains("| " + path + " |"));
            ++tables;
        }
    CHECK(tables == 115);
}
