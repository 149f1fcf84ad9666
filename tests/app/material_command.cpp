// SPDX-License-Identifier: Apache-2.0
// iride material as a script meets it: closed forms and published values in JSON, and bad input that ends with a
// message, exit code 2 and nothing on stdout.
#include <fmt/format.h>

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "spectral/catalogue.h"
#include "support/files.h"
#include "support/program.h"
#include "support/scenes.h"

using namespace iride;
using Catch::Matchers::Contains;
using nlohmann::json;

namespace {

json answer(std::string const& arguments) {
    test::RunResult const r =
        test::run_shell(std::string(IRIDE_PROGRAM) + " material " + arguments + " --json 2> /dev/null");
    INFO(arguments << ": " << r.text);
    REQUIRE(r.code == 0);
    return json::parse(r.text);
}

void check_refused(std::string const& arguments, std::string const& says) {
    std::string const command = std::string(IRIDE_PROGRAM) + " material " + arguments;
    test::RunResult const out = test::run_shell(command + " 2> /dev/null");
    test::RunResult const all = test::run_command(command);
    INFO(arguments << ": " << all.text);
    CHECK(out.code == 2);
    CHECK(out.text.empty());
    CHECK_THAT(all.text, Contains(says));
}

constexpr char const* camera = R"("camera": { "eye": [0,0,-5], "target": [0,0,0], "field_deg": 40 })";

}  // namespace

// Gold of Johnson and Christy, D65, CIE 1931: (1.038, .728, .365) by independent integration.
TEST_CASE("gold at normal incidence under D65 is outside sRGB and is not clamped", "[app]") {
    json const j = answer("Au --angle 0 90 --wavelength 500");
    CHECK(j["name"] == "Au");
    CHECK_THAT(j["source"].get<std::string>(), Contains("Johnson"));
    json const rgb = j["colour"][0]["linear_srgb"];
    CHECK(rgb[0].get<double>() == Approx(1.038).margin(5e-4));
    CHECK(rgb[1].get<double>() == Approx(.728).margin(5e-4));
    CHECK(rgb[2].get<double>() == Approx(.365).margin(5e-4));
    CHECK(j["colour"][0]["angle_deg"] == 0);
    // At grazing incidence everything is the light's colour, whose Y is 1.
    for (json const& v : j["colour"][1]["linear_srgb"]) CHECK(v.get<double>() == Approx(1).margin(1e-9));
    CHECK(j["colour"][1]["XYZ"][1].get<double>() == Approx(1).epsilon(1e-9));
    CHECK(j["colour"][1]["Lab"][0].get<double>() == Approx(100).epsilon(1e-9));
    // Both ends of the shift of 1982 are exact.
    for (json const& row : j["approximations"]["colour"])
        CHECK(row["interpolated_1982"]["delta_e_2000"].get<double>() < 1e-6);
}

// Exact complex formula: .91841108 at 60 degrees for .2 + 3i; Rs = 25 / 169 at Brewster's angle for 1.5.
TEST_CASE("a file of n and k and a glass reflect their closed forms", "[app]") {
    test::TemporaryFolder const folder;
    auto const metal = folder.write("metal.csv", "wavelength_nm,n,k\n400,.2,3\n800,.2,3\n");
    json const m = answer(metal.string() + " --angle 60 --wavelength 500 600.5")["reflectance"];
    REQUIRE(m.size() == 2);
    CHECK(m[1]["R"].get<double>() == Approx(.91841108).margin(5e-9));
    CHECK(m[1]["Rs"].get<double>() == Approx(.96241287).margin(5e-9));
    CHECK(m[1]["Rp"].get<double>() == Approx(.87440930).margin(5e-9));
    CHECK(m[1]["wavelength_nm"] == 600.5);
    CHECK(m[1]["k"] == 3);
    auto const glass = folder.write("glass.csv", "wavelength_nm,n,k\n400,1.5,0\n800,1.5,0\n");
    json const g = answer(glass.string() + " --angle 56.309932474 --wavelength 550")["reflectance"][0];
    CHECK(g["Rs"].get<double>() == Approx(25.0 / 169).epsilon(1e-9));
    CHECK(g["Rp"].get<double>() == Approx(0).margin(1e-15));
}

// A quarter wave: ((1.5168 - 1.38^2) / (1.5168 + 1.38^2))^2 on glass. Lambert: its reflectance, and no Rs and Rp.
TEST_CASE("materials of a scene file answer by name, smooth ones exactly, others by their albedo", "[app]") {
    test::TemporaryFolder const folder;
    auto const file = folder.write("scene.json", fmt::format(R"({{ {}, "materials": {{
        "lens": {{ "type": "dielectric", "ior": 1.5168, "coating": [ {{ "ior": 1.38, "thickness_nm": 99.6376811594203 }} ] }},
        "paint": {{ "type": "diffuse", "reflectance": 0.4 }}, "pit": {{ "type": "black" }},
        "mirror": {{ "type": "conductor", "ior": {{ "n": 0.2, "k": 3 }} }},
        "satin": {{ "type": "conductor", "ior": {{ "n": 0.2, "k": 3 }}, "roughness": 0.2 }} }} }})",
                                                             camera));
    json const lens = answer(file.string() + ":lens --angle 0 --wavelength 550")["reflectance"][0];
    double const film = 1.38 * 1.38;
    CHECK(lens["R"].get<double>() == Approx(std::pow((1.5168 - film) / (1.5168 + film), 2)).epsilon(1e-9));
    json const all = answer(file.string() + " --angle 60 --wavelength 550 700");
    REQUIRE(all.size() == 5);
    for (json const& m : all)
        for (json const& r : m["reflectance"]) {
            INFO(m["name"]);
            if (m["name"] == "paint") CHECK(r["R"].get<double>() == Approx(.4).epsilon(1e-5));
            if (m["name"] == "pit") CHECK(r["R"] == 0);
            if (m["name"] == "mirror") CHECK(r["R"].get<double>() == Approx(.91841108).margin(5e-9));
            if (m["name"] == "satin") CHECK(r["R"].get<double>() == Approx(.91).margin(.02));
            CHECK(r["Rs"].is_null() == (m["name"] != "mirror" && m["name"] != "lens"));
            CHECK(r["n"].is_null() == (m["name"] == "paint" || m["name"] == "pit"));
        }
    for (json const& m : all)
        if (m["name"] == "pit") CHECK(m["colour"][0]["xy"].is_null());
}

TEST_CASE("every shipped index answers at every angle with numbers", "[app]") {
    for (std::string const& name : catalogue_names(SpectralQuantity::complex_index)) {
        json const j = answer("'" + name + "' --angle 0 45 90");
        for (json const& r : j["reflectance"]) {
            INFO(name << r.dump());
            CHECK((r["R"].get<double>() >= 0 && r["R"].get<double>() <= 1));
        }
        CHECK(j.dump().find("nan") == std::string::npos);
        CHECK(j["colour"].size() == 3);
    }
}

TEST_CASE("iride material draws its page", "[app]") {
    test::TemporaryFolder const folder;
    std::string const file = (folder.path() / "page.png").string();
    test::RunResult const r = test::run_iride("material Cu --plot " + file);
    CHECK(r.code == 0);
    CHECK(test::content(file).substr(1, 3) == "PNG");
}

TEST_CASE("iride material refuses what it cannot answer", "[input]") {
    test::TemporaryFolder const folder;
    auto const scene =
        folder
            .write("scene.json", fmt::format(R"({{ {}, "materials": {{ "gold": {{ "type": "conductor", "ior": "Au" }},
                                          "paint": {{ "type": "diffuse", "reflectance": 0.4 }} }} }})",
                                             camera))
            .string();
    check_refused("Auu", "did you mean 'Au'");
    check_refused("D65", "no index of refraction");
    check_refused("cornell:red", "no index of refraction");
    check_refused(folder.write("n.csv", "wavelength_nm,n,k\n400,.2,3\n500,.2,nan\n").string(), "n.csv:3");
    check_refused(folder.write("k.csv", "wavelength_nm,n,k\n400,.2,-3\n500,.2,3\n").string(), "k down to -3");
    check_refused("Au --angle 91", "0 .. 90");
    check_refused("Au --angle nan", "0 .. 90");
    check_refused("Au --angle=-1", "0 .. 90");
    check_refused("Au --wavelength 100", "191.6 .. 1937");
    check_refused("Au --wavelength red", "red");
    check_refused("Au --illuminant D66", "D66");
    check_refused("Au --plot picture.jpg", ".png");
    check_refused("Au --plot /nowhere/picture.png", "nowhere");
    check_refused(scene + ":golf", "did you mean 'gold'");
    check_refused(scene + " --plot " + (folder.path() / "p.png").string(), "2 materials");
    check_refused((folder.path() / "none.json").string(), "none.json");
    check_refused("", "NAME");
}
