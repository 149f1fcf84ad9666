// SPDX-License-Identifier: Apache-2.0
// CGATS tables as instruments write them, and several spectra of a file at once.
#include <catch2/catch.hpp>

#include "base/diagnostics.h"
#include "spectral/catalogue.h"
#include "support/scenes.h"

using namespace iride;

namespace {

class Written {
  public:
    Written(std::string const& name, std::string const& text) : path_(folder_.write(name, text)) {}
    std::string path() const { return path_.string(); }

  private:
    test::TemporaryFolder folder_;
    std::filesystem::path path_;
};

std::string const head = R"(CTI3

DESCRIPTOR "Two patches"
KEYWORD "SPECTRAL_BANDS"
SPECTRAL_BANDS "4"
SPECTRAL_START_NM "380.000000"
SPECTRAL_END_NM "390.000000"
SPECTRAL_NORM "100.000000"
NUMBER_OF_FIELDS 6
BEGIN_DATA_FORMAT
SAMPLE_ID SAMPLE_NAME SPEC_380 SPEC_383 SPEC_387 SPEC_390
END_DATA_FORMAT
NUMBER_OF_SETS 2
BEGIN_DATA
)";

}  // namespace

TEST_CASE("a .ti3 gives a column per sample, in parts of one, at exact wavelengths", "[unit]") {
    Written const file("iride_cgats.ti3", head + "1 \"dark red\" 5.0 6.0 7.0 8.0\n2 grey 50 50 50 50\nEND_DATA\n");
    SpectrumFile const read = read_spectrum_file(file.path());
    REQUIRE(read.column_order == std::vector<std::string>{"dark red", "grey"});
    CHECK(read.wavelength_nm[1] == Approx(380 + 10.0 / 3).epsilon(1e-12));  // the field's name is rounded to 383
    CHECK(read.column.at("dark red") == std::vector<double>{.05, .06, .07, .08});
    auto const all = load_spectra(file.path(), SpectralQuantity::reflectance);
    REQUIRE(all.size() == 2);
    CHECK(all[1].name() == "grey");
    CHECK(all[1].at(700) == .5);  // a reflectance holds its end value
    CHECK(load_spectrum(file.path() + ":dark red", SpectralQuantity::reflectance).at(390) == .08);
    CHECK(load_spectra(file.path() + ":grey", SpectralQuantity::reflectance).size() == 1);
    CHECK(load_spectra("colorchecker", SpectralQuantity::reflectance).size() == 24);
    CHECK(load_spectra("D65", SpectralQuantity::power).size() == 1);
}

TEST_CASE("wavelengths that stand beside their values are read, in per cent or parts of one", "[unit]") {
    auto const text = [](std::string const& quantity, std::string const& rows) {
        return "CGATS.17\nBEGIN_DATA_FORMAT\nSAMPLE_ID SPECTRAL_NM " + quantity + " SPECTRAL_NM " + quantity +
               "\nEND_DATA_FORMAT\nBEGIN_DATA\n" + rows + "END_DATA\n";
    };
    Written const per_cent("iride_pct.txt", text("SPECTRAL_PCT", "a 400 50 500 60\nb 400 5 500 6\n")),
        parts("iride_dec.txt", text("SPECTRAL_DEC", "a 400 .5 500 .6\n"));
    CHECK(read_spectrum_file(per_cent.path()).wavelength_nm == std::vector<double>{400, 500});
    CHECK(read_spectrum_file(per_cent.path()).column.at("b") == std::vector<double>{.05, .06});
    CHECK(read_spectrum_file(parts.path()).column.at("a") == std::vector<double>{.5, .6});
    auto const refused = [](Written const& file) {
        try {
            read_spectrum_file(file.path());
        } catch (InputError const& error) {
            return std::string(error.what());
        }
        return std::string("accepted");
    };
    using Catch::Contains;
    CHECK_THAT(refused({"a.txt", text("SPECTRAL_DEC", "a 400 .5 500 .6\nb 400 .5 510 .6\n")}),
               Contains("a.txt:7") && Contains("found 510 nm where the first sample has 500"));
    CHECK_THAT(refused({"a.txt", text("SPECTRAL_X", "a 400 .5 500 .6\n")}), Contains("neither SPECTRAL_PCT"));
    CHECK_THAT(refused({"a.txt", text("SPECTRAL_DEC", "a 500 .5 400 .6\n")}), Contains("must increase"));
}

TEST_CASE("field names of other instruments are known, rows may wrap, samples without names are counted", "[unit]") {
    for (char const* fields :
         {"nm400 nm500", "SPECTRAL_NM_400 SPECTRAL_NM_500", "R_400 R_500", "SPECTRAL_NM400 SPECTRAL_NM500"}) {
        Written const file("iride_cgats.txt", std::string("CGATS.17\nBEGIN_DATA_FORMAT\n") + fields +
                                                  "\nEND_DATA_FORMAT\nBEGIN_DATA\n.1\n.2 .3\n.4\nEND_DATA\n");
        SpectrumFile const read = read_spectrum_file(file.path());
        INFO(fields);
        CHECK(read.column_order == std::vector<std::string>{"1", "2"});
        CHECK(read.wavelength_nm == std::vector<double>{400, 500});
        CHECK(read.column.at("2") == std::vector<double>{.3, .4});
    }
}

TEST_CASE("a CGATS table that is not whole is refused with its line", "[input]") {
    auto const refused = [](std::string const& text, std::string const& message) {
        Written const file("iride_cgats_bad.ti3", text);
        INFO(text);
        CHECK_THROWS_WITH(read_spectrum_file(file.path()), Catch::Contains(message));
    };
    refused(head + "1 a 1 2 3 4\n2 b 5 nan 7 8\nEND_DATA\n", ":16:1: found 'nan'");
    refused(head + "1 a 1 2 3 4\n2 b 5 6 7\nEND_DATA\n", "no rows of 6 fields");
    refused(head + "1 a 1 2 3 4\nEND_DATA\n", "found 1 samples, but NUMBER_OF_SETS is 2");
    refused(head + "1 a 1 2 3 4\n2 b 5 6 7 8\n", "no END_DATA follows");
    refused(head + "1 \"a 1 2 3 4\n2 b 5 6 7 8\nEND_DATA\n", "a quotation mark is not closed");
    refused("X\nBEGIN_DATA_FORMAT\nSAMPLE_ID XYZ_X\nEND_DATA_FORMAT\nBEGIN_DATA\n1 2\nEND_DATA\n",
            "no table with spectral fields");
    refused("X\nBEGIN_DATA_FORMAT\nnm500 nm400\nEND_DATA_FORMAT\nBEGIN_DATA\n1 2\nEND_DATA\n",
            "wavelength 400 after 500: they must increase");
    refused("X\nBEGIN_DATA_FORMAT\nnm400 nm400\nEND_DATA_FORMAT\nBEGIN_DATA\n1 2\nEND_DATA\n", "is there twice");
    refused("X\nBEGIN_DATA_FORMAT\nnm400 nm500\nEND_DATA_FORMAT\nBEGIN_DATA\nEND_DATA\n", "holds no samples");
    refused("X\nSPECTRAL_NORM 0\nBEGIN_DATA_FORMAT\nnm400 nm500\nEND_DATA_FORMAT\nBEGIN_DATA\n1 2\nEND_DATA\n",
            "SPECTRAL_NORM 0");
    refused(
        "X\nSPECTRAL_BANDS 3\nSPECTRAL_START_NM 400\nSPECTRAL_END_NM 500\nBEGIN_DATA_FORMAT\nnm400 nm500\n"
        "END_DATA_FORMAT\nBEGIN_DATA\n1 2\nEND_DATA\n",
        "found 2 spectral fields, but SPECTRAL_BANDS is 3");
}

TEST_CASE("a table says how it is summed, and nothing else about it", "[input]") {
    Written const good("iride_sum.csv", "# summation: tabulated\nnm,power\n400,1\n500,2\n");
    CHECK(std::get<TabulatedShape>(load_spectrum(good.path(), SpectralQuantity::power).shape()).summation ==
          Summation::tabulated);
    Written const bad("iride_sum_bad.csv", "# summation: tabulatd\nnm,power\n400,1\n500,2\n");
    CHECK_THROWS_WITH(read_spectrum_file(bad.path()), Catch::Contains("did you mean 'tabulated'"));
}
