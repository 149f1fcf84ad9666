// SPDX-License-Identifier: Apache-2.0
// Every format of spectrum file is read to the number, and everything else is refused with the file, the line, what was
// found and what is wanted.
#include <catch2/catch.hpp>

#include "spectral/catalogue.h"
#include "support/scenes.h"

using namespace iride;
using Catch::Matchers::Contains;

namespace {

SpectrumFile read(std::string const& name, std::string const& content) {
    test::TemporaryFolder const folder;
    return read_spectrum_file(folder.write(name, content));
}

// The message, without the folder.
std::string refusal(std::string const& name, std::string const& content) {
    test::TemporaryFolder const folder;
    try {
        read_spectrum_file(folder.write(name, content));
    } catch (InputError const& e) {
        std::string const text = e.what();
        return text.substr(text.find(name));
    }
    return "(accepted)";
}

std::string yaml(std::string const& data) { return "REFERENCES: \"somebody, 2001\"\nDATA:\n" + data; }

using Numbers = std::vector<double>;

}  // namespace

TEST_CASE("our own format gives quantity, unit, source and columns", "[unit]") {
    SpectrumFile const f = read("paint.csv",
                                "# name: paint\n# quantity: reflectance\n# unit: wavelength nm; 0..1\n# source: me\n"
                                "wavelength_nm,red,green\n400,.1,.2\n410.5,.3,4e-1\n");
    CHECK(f.quantity == "reflectance");
    CHECK(f.unit == "wavelength nm; 0..1");
    CHECK(f.source == "me");
    CHECK(f.wavelength_nm == Numbers{400, 410.5});
    CHECK(f.column_order == std::vector<std::string>{"red", "green"});
    CHECK(f.column.at("red") == Numbers{.1, .3});
    CHECK(f.column.at("green") == Numbers{.2, .4});
}

TEST_CASE("tables of others are read with any separator, ending or byte order mark", "[unit]") {
    for (std::string const content :
         {"400 .1\n410 .3\n", "400\t.1\n410\t.3", "400,.1\r\n410,.3\r\n", "400;.1\n410;.3\n",
          "\xef\xbb\xbf"
          "400, .1\n410, .3\n",
          "# a comment: with a colon\n\n 400  .1 \n\n410 .3\n"}) {
        INFO(content);
        SpectrumFile const f = read("lamp.spd", content);
        CHECK(f.wavelength_nm == Numbers{400, 410});
        CHECK(f.column.at("value") == Numbers{.1, .3});
    }
    SpectrumFile const f = read("lamp.txt", "400 1 2\n410 3 4\n");
    CHECK(f.column.at("value2") == Numbers{2, 4});
}

TEST_CASE("a refractiveindex.info CSV is read as it is pasted", "[unit]") {
    SpectrumFile const f = read("Au.csv", "wl,n\n0.1879,1.28\n0.1916,1.32\n\nwl,k\n0.1879,1.188\n0.1916,1.203\n");
    REQUIRE(f.wavelength_nm.size() == 2);
    CHECK(f.wavelength_nm[0] == Approx(187.9).epsilon(1e-15));
    CHECK(f.wavelength_nm[1] == Approx(191.6).epsilon(1e-15));
    CHECK(f.column.at("n") == Numbers{1.28, 1.32});
    CHECK(f.column.at("k") == Numbers{1.188, 1.203});
}

// Fails if the second block is laid on the wavelengths of the first, or if k is dropped.
TEST_CASE("n and k over different wavelengths meet where they overlap", "[unit]") {
    for (SpectrumFile const& f :
         {read("a.csv", "wl,n\n.4,1\n.5,2\n.7,4\nwl,k\n.45,.5\n.6,2\n.8,4\n"),
          read("a.yml", yaml("  - type: tabulated n\n    data: |\n        0.4 1\n        0.5 2\n        0.7 4\n"
                             "  - type: tabulated k\n    data: |\n        0.45 .5\n        0.6 2\n        0.8 4\n"))}) {
        REQUIRE(f.wavelength_nm.size() == 4);
        Numbers const nm{450, 500, 600, 700}, n{1.5, 2, 3, 4}, k{.5, 1, 2, 3};
        for (std::size_t i = 0; i < 4; ++i) {
            CHECK(f.wavelength_nm[i] == Approx(nm[i]));
            CHECK(f.column.at("n")[i] == Approx(n[i]));
            CHECK(f.column.at("k")[i] == Approx(k[i]));
        }
    }
}

TEST_CASE("a refractiveindex.info YAML is read as it is pasted", "[unit]") {
    SpectrumFile const table = read("Au.yml",
                                    "# this file is part of refractiveindex.info database\n"
                                    "# it is in the public domain\n\n"
                                    "REFERENCES: \"P. B. Johnson and R. W. Christy. 1972\"\n"
                                    "COMMENTS: \"Room temperature\"\n"
                                    "DATA:\n  - type: tabulated nk\n    data: |\n"
                                    "        0.1879 1.28 1.188\n        0.1916 1.32 1.203\n");
    CHECK(table.source == "P. B. Johnson and R. W. Christy. 1972");
    CHECK(table.wavelength_nm.front() == Approx(187.9).epsilon(1e-15));
    CHECK(table.column.at("n") == Numbers{1.28, 1.32});
    CHECK(table.column.at("k") == Numbers{1.188, 1.203});

    // A glass: the formula counts, its absorption does not yet. Data sheet of N-BK7: n_d = 1.51680.
    test::TemporaryFolder const folder;
    folder.write("BK.yml", yaml("  - type: formula 2 \n    wavelength_range: 0.3 2.5\n    coefficients: 0 1.03961212 "
                                "0.00600069867 0.231792344 0.0200179144 1.01046945 103.560653\n"
                                "  - type: tabulated k\n    data: |\n        0.3 2.8E-06\n        2.5 1.1e-5\n"));
    ComplexIndex const glass = load_complex_index("BK.yml", folder.path());
    CHECK(glass.n.at(587.5618) == Approx(1.51680).margin(5e-6).epsilon(0));
    CHECK(glass.n.defined_on() == WavelengthRange{300, 2500});
    CHECK(glass.k.at(500) == 0);
}

// Closed forms at L = 0.5 and 2 micrometres. Formula 4 fails without its terms beyond the two poles.
TEST_CASE("formulas 1, 2 and 4 are what refractiveindex.info means by them", "[unit]") {
    auto const index = [](std::string const& type, std::string const& coefficients, double nm) {
        test::TemporaryFolder const folder;
        folder.write("x.yml", yaml("  - type: " + type +
                                   "\n    wavelength_range: 0.4 3\n    coefficients: " + coefficients + "\n"));
        return load_complex_index("x.yml", folder.path()).n.at(nm);
    };
    CHECK(index("formula 1", "0.25 1 0.3", 500) == Approx(std::sqrt(1.25 + .25 / (.25 - .09))).epsilon(1e-14));
    CHECK(index("formula 2", "0.25 1 0.09", 500) == Approx(std::sqrt(1.25 + .25 / (.25 - .09))).epsilon(1e-14));
    CHECK(index("formula 4", "2 0.5 2 0.3 2", 500) == Approx(std::sqrt(2 + .125 / (.25 - .09))).epsilon(1e-14));
    CHECK(index("formula 4", "2 0.5 0 0.3 2 0 0 0 1 0.1 2 -0.01 4", 2000) ==
          Approx(std::sqrt(2 + .5 / (4 - .09) + .1 * 4 - .01 * 16)).epsilon(1e-14));
}

TEST_CASE("a bad number is refused with its line", "[input]") {
    CHECK_THAT(refusal("a.csv", "nm,value\n400,.1\n410,x1\n"), Contains("a.csv:3:1: found 'x1', but a finite number"));
    CHECK_THAT(refusal("a.csv", "nm,value\n400,.1\nx410,.2\n420,.3\n"), Contains("a.csv:3:1: found 'x410'"));
    CHECK_THAT(refusal("a.csv", "400,.1\nabc,.2\n"), Contains("a.csv:2:1: found 'abc'"));
    CHECK_THAT(refusal("a.csv", "400,.1\n410,nan\n"), Contains("a.csv:2:1: found 'nan'"));
    CHECK_THAT(refusal("a.csv", "nan,.1\n"), Contains("a.csv:1:1: found 'nan'"));
    CHECK_THAT(refusal("a.csv", "400,inf\n"), Contains("a.csv:1:1: found 'inf'"));
    CHECK_THAT(refusal("a.csv", "400,1e999\n"), Contains("a.csv:1:1: found '1e999'"));
    CHECK_THAT(refusal("a.csv", "400,.1\n410,\n"), Contains("a.csv:2:1: found ''"));
    CHECK_THAT(refusal("a.csv", "400;0,5\n"), Contains("a.csv:1:1: found '0,5'"));  // a decimal comma
    CHECK_THAT(refusal("a.yml", yaml("  - type: tabulated n\n    data: |\n        0.4 1\n        0.5 nan\n")),
               Contains("a.yml:6:1: found 'nan'"));
    CHECK_THAT(refusal("a.yml", yaml("  - type: formula 1\n    wavelength_range: 0.4 3\n    coefficients: 0 1 o.3\n")),
               Contains("a.yml:5:1: found 'o.3'"));
}

TEST_CASE("wavelengths that do not increase from above zero are refused with their line", "[input]") {
    CHECK_THAT(refusal("a.csv", "nm,v\n400,1\n420,1\n410,1\n"),
               Contains("a.csv:4:1: wavelength 410 after 420: they must increase"));
    CHECK_THAT(refusal("a.csv", "nm,v\n400,1\n400,2\n"), Contains("a.csv:3:1: wavelength 400 is there twice"));
    CHECK_THAT(refusal("a.csv", "nm,v\n0,1\n400,2\n"), Contains("a.csv:2:1: wavelength 0: it must be above 0"));
    CHECK_THAT(refusal("a.csv", "nm,v\n-400,1\n"), Contains("a.csv:2:1: wavelength -400"));
    CHECK_THAT(refusal("a.yml", yaml("  - type: tabulated nk\n    data: |\n        0.5 1 0\n        0.4 1 0\n")),
               Contains("a.yml:6:1: wavelength 400 after 500"));
    CHECK_THAT(refusal("a.txt", "0.4 1\n0.5 2\n"), Contains("a.txt:2:1: wavelengths up to 0.5: nanometres are wanted"));
}

TEST_CASE("missing, surplus and repeated columns are refused", "[input]") {
    CHECK_THAT(refusal("a.csv", "nm,n,k\n400,1,2\n410,1\n"), Contains("a.csv:3:1: found 2 columns, but 3 are wanted"));
    CHECK_THAT(refusal("a.csv", "nm,n\n400,1,2\n"), Contains("a.csv:2:1: found 3 columns, but 2 are wanted"));
    CHECK_THAT(refusal("a.csv", "400\n410\n"), Contains("a.csv:1:1: found 1 column"));
    CHECK_THAT(refusal("a.csv", "nm,n,n\n400,1,2\n"), Contains("a.csv: column 'n' is there twice"));
    CHECK_THAT(refusal("a.csv", "wl,n\n.4,1\nwl,n\n.4,2\n"), Contains("a.csv: column 'n' is there twice"));
    CHECK_THAT(refusal("a.csv", "wl,n\n.4,1\n.5,1\nwl,k\n"), Contains("a.csv: no rows of k"));
    CHECK_THAT(refusal("a.csv", "wl,n\n.4,1\n.5,1\nwl,k\n.6,1\n.7,1\n"), Contains("no wavelength in common"));
    CHECK_THAT(refusal("a.yml", yaml("  - type: tabulated nk\n    data: |\n        0.4 1\n")),
               Contains("a.yml:5:1: found 2 columns, but 3 are wanted"));
    test::TemporaryFolder const folder;
    folder.write("k.csv", "nm,k\n400,1\n");
    folder.write("two.csv", "nm,red,green\n400,1,1\n");
    CHECK_THROWS_WITH(load_complex_index("k.csv", folder.path()), Contains("k.csv: no column 'n'; allowed: k"));
    CHECK_THROWS_WITH(load_spectrum("two.csv", SpectralQuantity::reflectance, folder.path()),
                      Contains("holds 2 columns: choose one as 'two.csv:red'"));
    CHECK_THROWS_WITH(load_spectrum("two.csv:gren", SpectralQuantity::reflectance, folder.path()),
                      Contains("no column 'gren'; did you mean 'green'?"));
    CHECK(load_spectrum("two.csv:green", SpectralQuantity::reflectance, folder.path()).at(400) == 1);
}

TEST_CASE("files without numbers, and what is no file, are refused", "[input]") {
    CHECK_THAT(refusal("a.csv", ""), Contains("a.csv: holds no rows of numbers"));
    CHECK_THAT(refusal("a.csv", "# unit: nm\nnm,value\n"), Contains("a.csv: holds no rows of numbers"));
    CHECK_THAT(refusal("a.csv", "what is this\n"), Contains("a.csv: holds no rows of numbers"));
    CHECK_THAT(refusal("a.csv", "what\n"), Contains("a.csv:1:1: found 'what', but columns of numbers are wanted"));
    CHECK_THAT(refusal("a.yml", ""), Contains("a.yml: holds no DATA"));
    CHECK_THAT(refusal("a.yml", "DATA:\n"), Contains("a.yml: holds no DATA"));
    CHECK_THAT(refusal("a.yml", "REFERENCES: x\n"), Contains("a.yml: holds no DATA"));
    CHECK_THAT(refusal("a.yml", "DATA: [\n"), Contains("a.yml:") && Contains("not the YAML of refractiveindex.info"));
    CHECK_THAT(refusal("a.yml", yaml("  - data: |\n        0.4 1\n")), Contains("not the YAML of refractiveindex"));
    test::TemporaryFolder const folder;
    CHECK_THROWS_WITH(read_spectrum_file(folder.path() / "no.csv"), Contains("no.csv: no such file"));
    CHECK_THROWS_WITH(read_spectrum_file(folder.path()), Contains("is not a regular file"));
    auto const big = folder.write("big.csv", "");
    std::filesystem::resize_file(big, (64u << 20) + 1);  // sparse
    CHECK_THROWS_WITH(read_spectrum_file(big), Contains("big.csv: larger than 64 MiB"));
}

TEST_CASE("formulas that are none of ours, or give no index, are refused with their line", "[input]") {
    auto const formula = [](std::string const& type, std::string const& range, std::string const& coefficients) {
        return refusal("a.yml", yaml("  - type: " + type + "\n    wavelength_range: " + range +
                                     "\n    coefficients: " + coefficients + "\n"));
    };
    CHECK_THAT(formula("formula 3", "0.4 1", "0 1 2"),
               Contains("a.yml:3:1: DATA of type 'formula 3'; allowed: tabulated n, k, nk, formula 1, 2, 4"));
    CHECK_THAT(formula("formula 1", "0.4", "0 1 .1"), Contains("a.yml:4:1: wavelength_range wants two numbers"));
    CHECK_THAT(formula("formula 1", "1 0.4", "0 1 .1"), Contains("the range must be above 0 and increase"));
    CHECK_THAT(formula("formula 1", "0.4 1", "0 1"),
               Contains("a.yml:5:1: a formula with 2 coefficients, allowed: 3, 5, 7, ..."));
    CHECK_THAT(formula("formula 4", "0.4 1", "1 1 0 0 1 1 0"),
               Contains("a formula with 7 coefficients, allowed: 5, 9, 11, 13, ..."));
    CHECK_THAT(formula("formula 1", "0.4 1", "0 1 0.5"),  // a pole at 500 nm
               Contains("a.yml:5:1: the formula gives no index at"));
    CHECK_THAT(refusal("a.yml", yaml("  - type: tabulated n\n    data: |\n        0.4 1\n"
                                     "  - type: tabulated nk\n    data: |\n        0.4 1 2\n")),
               Contains("a.yml:6:1: DATA gives n twice"));
    std::string const rows = "index,coefficient\n0,0\n1,1\n2,.01\n";
    CHECK_THAT(refusal("a.csv", "# formula: cauchy\n# valid_nm: 400,800\n" + rows),
               Contains("a.csv:1:1: a formula needs '# formula: sellmeier|general ...' and '# valid_nm: from,to'"));
    CHECK_THAT(refusal("a.csv", "# formula: sellmeier c[2i+2]\n" + rows), Contains("a.csv:1:1: a formula needs"));
    CHECK_THAT(refusal("a.csv", "# formula: sellmeier c[2i+2]\n# valid_nm: 400,x\n" + rows),
               Contains("a.csv:2:1: found 'x'"));
    CHECK_THAT(refusal("a.csv", "# formula: sellmeier c[2i+2]\n# valid_nm: 400,800\nindex,coefficient\n0,0\n2,1\n"),
               Contains("a.csv:5:1: coefficient 1 is wanted"));
    CHECK_THAT(refusal("a.csv", "# formula: sellmeier c[2i+2]\n# valid_nm: 400,800\nindex,coefficient\n0,0\n"),
               Contains("a formula with 1 coefficients"));
}
