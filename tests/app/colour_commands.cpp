// SPDX-License-Identifier: Apache-2.0
// iride colour spectrum, convert, difference, diagram as a script meets them: published values in JSON, and bad input
// that ends with a message, exit code 2 and nothing on stdout.
#include <fmt/format.h>

#include <catch2/catch.hpp>
#include <cmath>
#include <nlohmann/json.hpp>

#include "base/picture.h"
#include "support/files.h"
#include "support/program.h"
#include "support/scenes.h"

using namespace iride;
using Catch::Matchers::Contains;
using nlohmann::json;

namespace {

json answer(std::string const& arguments) {
    test::RunResult const r = test::run_iride("colour " + arguments);
    INFO(arguments << ": " << r.text);
    REQUIRE(r.code == 0);
    return json::parse(r.text);
}

void check_numbers(json const& got, std::vector<double> const& wanted, double margin) {
    REQUIRE(got.size() == wanted.size());
    for (std::size_t i = 0; i < wanted.size(); ++i)
        CHECK(got[i].get<double>() == Approx(wanted[i]).margin(margin).epsilon(0));
}

// Exit code 2, nothing on stdout, a message that says `says`.
void check_refused(std::string const& arguments, std::string const& says) {
    std::string const command = std::string(IRIDE_PROGRAM) + " colour " + arguments;
    test::RunResult const out = test::run_command("(" + command + " 2> /dev/null)");
    test::RunResult const error = test::run_command("(" + command + " > /dev/null)");
    INFO(arguments << ": " << out.text << error.text);
    CHECK(out.code == 2);
    CHECK(out.text.empty());
    CHECK_THAT(error.text, Contains(says));
}

}  // namespace

TEST_CASE("colour convert gives the published L*u*v* triple", "[app]") {
    json const j = answer("convert --from XYZ --to Luv --white .3127,.3290 .20654008 .12197225 .05136952 --json");
    CHECK(j["from"] == "XYZ");
    CHECK(j["to"] == "Luv");
    check_numbers(j["white"], {.3127, .3290}, 0);
    check_numbers(j["value"], {41.52787529, 96.83626054, 17.75210149}, 1e-7);
}

TEST_CASE("colour convert goes there and back through every space", "[app]") {
    for (char const* space : {"xyY", "uvY", "Luv", "LCHuv", "Lab", "LCHab", "sRGB", "linear-sRGB", "Rec709", "Rec2020",
                              "DisplayP3", "AdobeRGB", "ACES2065-1", "ACEScg"})
        for (char const* white : {"D65", "D50", ".31,.33", "FL2:table"}) {
            std::string const options = fmt::format("--json --white {} ", white);
            json const there = answer(fmt::format("convert {} --from XYZ --to {} .3 .4 .2", options, space))["value"];
            json const back = answer(fmt::format("convert {} --from {} --to XYZ -- {} {} {}", options, space,
                                                 there[0].dump(), there[1].dump(), there[2].dump()))["value"];
            INFO(space << " " << white);
            check_numbers(back, {.3, .4, .2}, 1e-12);
        }
}

// The white of an RGB space is white under any white; L* 50 is grey of luminance .18418651851.
TEST_CASE("colour convert adapts white to white", "[app]") {
    for (char const* method : {"bradford", "cat02", "cat16", "von_kries"})
        check_numbers(answer(fmt::format("convert --json --from ACEScg --to Lab --white D50 --adaptation {} 1 1 1",
                                         method))["value"],
                      {100, 0, 0}, 1e-10);
    json const grey = answer("convert --json --from Lab --to linear-sRGB --white A 50 0 0")["value"];
    check_numbers(grey, {.18418651851, .18418651851, .18418651851}, 1e-10);
    // Without adaptation D65's own XYZ is white, under whatever white it stands.
    check_numbers(answer(fmt::format("convert --json --from XYZ --to linear-sRGB --white E --adaptation none {} 1 {}",
                                     .3127 / .3290, .3583 / .3290))["value"],
                  {1, 1, 1}, 1e-12);
}

TEST_CASE("colour convert streams lines of numbers and stops at a bad one, naming it", "[app]") {
    test::TemporaryFolder const folder;
    std::string const in = folder.write("in", "# X Y Z\n.2 .3 .4\n\n.2,.3,.4\r\n  +.2 , .3\t.4").string();
    test::RunResult r = test::run_iride("colour convert --from XYZ --to xyY < " + in);
    CHECK(r.code == 0);
    double x = 0, y = 0, Y = 0;
    CHECK(std::count(r.text.begin(), r.text.end(), '\n') == 3);
    REQUIRE(std::sscanf(r.text.c_str(), "%lf %lf %lf", &x, &y, &Y) == 3);
    CHECK(x == Approx(2 / 9.).epsilon(1e-14));
    CHECK(y == Approx(3 / 9.).epsilon(1e-14));
    for (auto const& [line, says] : std::vector<std::pair<std::string, std::string>>{{"1 2", "three numbers"},
                                                                                     {"1 2 3 4", "three numbers"},
                                                                                     {"1 2 x", "three numbers"},
                                                                                     {"1 nan 2", "finite"},
                                                                                     {"1 inf 2", "finite"},
                                                                                     {".1 -.2 .3", "not negative"},
                                                                                     {"1 2 3e", "three numbers"}}) {
        std::string const bad = folder.write("bad", ".2 .3 .4\n" + line + "\n.5 .5 .5\n").string();
        r = test::run_iride("colour convert --json --from XYZ --to Lab < " + bad);
        INFO(r.text);
        CHECK(r.code == 2);
        CHECK_THAT(r.text, Contains("line 2: ") && Contains(says));
        CHECK(r.text.find("\"value\"") == r.text.rfind("\"value\""));  // the one good line before it
    }
    CHECK(test::run_iride("colour convert --from XYZ --to Lab < /dev/null").text.empty());
}

TEST_CASE("colour difference gives the published CIEDE2000, and takes negative numbers after --", "[app]") {
    json const j = answer("difference --json --formula cie2000 -- 50 2.6772 -79.7751 50 0 -82.7485");
    CHECK(j["formula"] == "cie2000");
    CHECK(j["value"].get<double>() == Approx(2.0425).margin(5.1e-5).epsilon(0));
    CHECK(answer("difference --json --formula cie1976 50 0 0 50 3 4")["value"] == 5);
    CHECK(test::run_iride("colour difference --formula cie1976 50 0 0 50 3 4").text == "5\n");
    for (char const* formula : {"cie1994", "cmc"})
        CHECK(answer(fmt::format("difference --json --formula {} 50 2 3 50 2 3", formula))["value"] == 0);
}

TEST_CASE("colour spectrum gives CIE's white points with every field", "[app]") {
    json const d65 = answer("spectrum D65 --json");
    check_numbers(d65["xy"], {.31272, .32903}, 5e-5);
    check_numbers(d65["Lab"], {100, 0, 0}, 1e-10);
    CHECK(d65["XYZ"][1] == 100);
    CHECK(d65["dominant_wavelength_nm"].is_null());
    CHECK(d65["excitation_purity"] == 0);
    json const fl2 = answer("spectrum FL2 --json");
    check_numbers(fl2["xy"], {.37207, .37512}, 5e-5);
    check_numbers(answer("spectrum D65 --observer cie1964_10deg --json")["xy"], {.31382, .33100}, 5e-5);
    json const body = answer("spectrum blackbody:2700 --json");
    CHECK(body["cct_K"].get<double>() == Approx(2700).margin(1));
    CHECK(body["duv"].get<double>() == Approx(0).margin(1e-5));
    for (char const* field : {"XYZ", "xy", "uv_prime", "Luv", "Lab", "dominant_wavelength_nm",
                              "complementary_wavelength_nm", "excitation_purity", "cct_K", "duv"})
        CHECK(body.contains(field));
}

// The published chromaticities of polished metals under D65, of their published n + ik.
TEST_CASE("a metal by name is its reflectance at normal incidence", "[app]") {
    json const metals = answer("spectrum Au Cu --json");
    check_numbers(metals[0]["xy"], {.3818, .3887}, 1.5e-4);
    check_numbers(metals[1]["xy"], {.3558, .3456}, 1.5e-4);
}

TEST_CASE("a purple has no dominant wavelength in JSON, and no correlated temperature far from blackbodies", "[app]") {
    json const j = answer("spectrum colorchecker:magenta --json");
    CHECK(j["quantity"] == "reflectance");
    CHECK(j["dominant_wavelength_nm"].is_null());
    CHECK(j["complementary_wavelength_nm"].get<double>() == Approx(510).margin(1));
    CHECK(j["cct_K"].is_null());
    CHECK(j["duv"].is_null());
}

TEST_CASE("several spectra make an array, a file's own words say whether it is a light", "[app]") {
    test::TemporaryFolder const folder;
    std::string const lamp = folder.write("lamp.csv", "wavelength_nm,power\n400,50\n700,50\n").string();
    std::string const lamp_spd = folder.write("lamp.spd", "400 50\n700 50\n").string();
    std::string const paint = folder.write("paint.csv", "wavelength_nm,a,b\n360,.5,1\n830,.5,1\n").string();
    json const j = answer("spectrum --json colorchecker " + lamp + " " + lamp_spd + " " + paint);
    REQUIRE(j.size() == 28);
    CHECK(j[24]["quantity"] == "power");
    CHECK(j[24]["XYZ"] == j[25]["XYZ"]);
    CHECK(j[26]["name"] == "a");
    CHECK(j[26]["XYZ"][1].get<double>() == Approx(50).epsilon(1e-12));
    check_numbers(j[27]["Lab"], {100, 0, 0}, 1e-9);
    // Black has no chromaticity: null, not NaN.
    json const black = answer("spectrum --json " + folder.write("black.csv", "nm,r\n360,0\n830,0\n").string());
    CHECK(black["xy"].is_null());
    CHECK(black["cct_K"].is_null());
    check_numbers(black["Lab"], {0, 0, 0}, 1e-12);
}

TEST_CASE("bad input of the colour commands ends with a message, exit code 2 and nothing on stdout", "[input]") {
    test::TemporaryFolder const folder;
    check_refused("convert --from Lub --to XYZ 1 1 1", "did you mean 'Luv'");
    check_refused("convert --from XYZ --to sRBG 1 1 1", "did you mean 'sRGB'");
    check_refused("convert --from XYZ --to Lab --white D66 1 1 1", "D65");
    check_refused("convert --from XYZ --to Lab --white .3,0 1 1 1", "x > 0, y > 0");
    check_refused("convert --from XYZ --to Lab --white .3,nan 1 1 1", "x > 0, y > 0");
    check_refused("convert --from XYZ --to sRGB --adaptation brad 1 1 1", "bradford");
    check_refused("convert --from XYZ --to Lab nan 1 1", "finite");
    check_refused("convert --from sRGB --to Lab inf 1 1", "finite");
    check_refused("convert --from sRGB --to sRGB nan 1 1", "finite");
    check_refused("convert --from sRGB --to linear-sRGB 1e200 1 1", "finite");
    check_refused("convert --from XYZ --to Lab -- -.5 1 1", "not negative");
    check_refused("convert --from xyY --to Lab .3 0 1", "no colour");
    check_refused("convert --from XYZ --to xyY 0 0 0", "X + Y + Z = 0");
    check_refused("convert --from sRGB --to uvY 0 0 0", "has no chromaticity");
    check_refused("convert --from XYZ --to Lab 1 1", "three numbers");
    check_refused("convert --to Lab 1 1 1", "--from");
    check_refused("difference --formula cie2001 50 0 0 50 0 0", "did you mean 'cie2000'");
    check_refused("difference --formula cie2000 50 0 0 50 0", "six numbers");
    check_refused("difference --formula cie2000 50 0 nan 50 0 0", "finite");
    check_refused("difference --formula cie2000 50 0 1e300 50 0 0", "finite");
    check_refused("spectrum D66 --json", "did you mean 'D65'");
    check_refused("spectrum " + folder.write("infrared.csv", "wl,n\n1.0,2\n2.0,3\n\nwl,k\n1.0,2\n2.0,3\n").string(),
                  "not known in the visible");
    check_refused("spectrum D65 --observer cie1932_2deg", "cie1931_2deg");
    check_refused("spectrum D65 --plot /nonexistent/a.png", "does not exist");
    check_refused("spectrum D65 --plot a.pdf", ".png");
    for (auto const& [text, says] :
         std::vector<std::pair<std::string, std::string>>{{"wavelength_nm,r\n400,50\n700,60\n", "percent"},
                                                          {"wavelength_nm,r\n.4,.5\n.7,.6\n", "nanometres are wanted"},
                                                          {"wavelength_nm,r\n400,.5\n500\n", ":3"},
                                                          {"wavelength_nm,r\n400,.5\n500,nan\n", ":3"},
                                                          {"wavelength_nm,r\n400,.5\n500,inf\n", ":3"},
                                                          {"wavelength_nm,r\n500,.5\n400,.5\n", ":3"},
                                                          {"wavelength_nm,r\n400,.5\n400,.5\n", ":3"},
                                                          {"wavelength_nm,r\n400,-.5\n500,-.5\n", "0..1"},
                                                          {"wavelength_nm,power\n400,0\n500,0\n", "0"},
                                                          {"wavelength_nm,power\n400,-1\n500,2\n", "negative"},
                                                          {"wavelength_nm,r\n900,.5\n1000,.5\n", "360 .. 830 nm"},
                                                          {"", "bad.csv"}}) {
        INFO(text);
        check_refused("spectrum --json " + folder.write("bad.csv", text).string(), says);
    }
    check_refused("diagram -o " + (folder.path() / "a.png").string() + " --space xyz", "xy");
    check_refused("diagram -o " + (folder.path() / "a.jpg").string(), ".png");
    check_refused("diagram -o " + (folder.path() / "a.png").string() + " /nonexistent.exr", "nonexistent.exr");
    check_refused("diagram", "--output");
    CHECK(!std::filesystem::exists(folder.path() / "a.png"));
}

namespace {

// In 0 .. 255.
std::array<int, 3> pixel_of(Picture const& picture, int x, int y) {
    auto const byte = [&](int channel) { return static_cast<int>(std::lround(255 * picture.at(x, y, channel))); };
    return {byte(0), byte(1), byte(2)};
}

}  // namespace

// Where a colour lies in the picture is known from the axes: x -.08 .. .8 over 1496 pixels from the 130th.
TEST_CASE("the diagram is white outside the locus, coloured inside, and has every point", "[app]") {
    test::TemporaryFolder const folder;
    std::string const file = (folder.path() / "a.png").string();
    REQUIRE(
        test::run_iride("render metals --size 32x18 --spp 4 --quiet -o " + folder.path().string() + "/m.exr").code ==
        0);
    test::RunResult const r =
        test::run_iride("colour diagram -o " + file + " colorchecker:red " + folder.path().string() + "/m.exr");
    INFO(r.text);
    REQUIRE(r.code == 0);
    Picture const png = read_picture(file, {.least_channels = 3});
    auto const at = [&](double x, double y) {
        return pixel_of(png, static_cast<int>(130 + (x + .08) / .88 * 1496),
                        static_cast<int>(40 + (.9 - y) / .92 * 1564));
    };
    CHECK(at(.62, .52) == std::array{255, 255, 255});  // nothing there
    auto const [red, green, blue] = at(.60, .32);
    CHECK((red > 230 && green < 130 && blue < 130));
    auto const [r2, g2, b2] = at(.10, .75);
    CHECK((g2 > 230 && r2 < 130));
    json const patch = answer("spectrum colorchecker:red --json");
    CHECK(at(patch["xy"][0], patch["xy"][1]) == std::array{0, 0, 0});
    CHECK(test::run_iride("colour diagram --space uv -o " + file).code == 0);
    CHECK(test::run_iride("colour spectrum A FL2 colorchecker:red --plot " + file).code == 0);
}
