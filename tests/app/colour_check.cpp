// SPDX-License-Identifier: Apache-2.0
// iride colour check as a script meets it: exit codes, JSON on stdout alone, messages on stderr alone.
#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>
#include <regex>

#include "support/files.h"
#include "support/program.h"
#include "support/scenes.h"

using namespace iride;
using Catch::Matchers::Contains;

namespace {

struct Result {
    int code;
    std::string out, error;
};

Result check(test::TemporaryFolder const& folder, std::string const& arguments, std::string const& before = {}) {
    std::string const error = (folder.path() / "stderr").string();
    std::string const command = before + " " + IRIDE_PROGRAM + " colour check " + arguments + " 2> " + error;
    test::RunResult const r = test::run_shell(command);
    return {r.code, r.text, test::content(error)};
}

std::string const shipped = std::string(IRIDE_SOURCE_DIR) + "/data/ocio/config.ocio";

}  // namespace

TEST_CASE("colour check of the shipped config says ok in JSON and as a table", "[app]") {
    test::TemporaryFolder const folder;
    Result const r = check(folder, "--json --config " + shipped);
    CHECK(r.code == 0);
    CHECK(r.error.empty());
    auto const json = nlohmann::json::parse(r.out);
    CHECK(json["ok"] == true);
    CHECK(json["spaces"].size() == 31);
    for (auto const& space : json["spaces"]) {
        CHECK(space["ok"] == true);
        CHECK(space["max_error"].get<double>() <= space["tolerance"].get<double>());
        CHECK(space["delta_e_2000_max"].get<double>() < .002);
        CHECK(space["name"].is_string());
    }
    Result const table = check(folder, "");
    CHECK(table.code == 0);
    CHECK_THAT(table.out, Contains("CIE Luv (D50)") && Contains("Raw: data, no colour"));
}

TEST_CASE("colour check of a wrong config exits with 3 and still prints whole JSON", "[app]") {
    test::TemporaryFolder const folder;
    std::string const text = std::regex_replace(test::content(shipped), std::regex("value: 2.19921875"), "value: 2.3");
    std::string const path = folder.write("wrong.ocio", text).string();
    Result const r = check(folder, "--json", "OCIO=" + path);  // the variable is honoured
    CHECK(r.code == 3);
    auto const json = nlohmann::json::parse(r.out);
    CHECK(json["ok"] == false);
    int wrong = 0;
    for (auto const& space : json["spaces"]) wrong += space["ok"] == false;
    CHECK(wrong == 1);
    CHECK_THAT(r.error, Contains("'AdobeRGB - Texture' is not Adobe RGB texture"));
}

TEST_CASE("colour check of what is no config exits with 2 and prints nothing on stdout", "[input]") {
    test::TemporaryFolder const folder;
    std::string const no_role =
        std::regex_replace(test::content(shipped), std::regex("  aces_interchange: ACES2065-1\n"), "");
    for (auto const& [path, says] : std::vector<std::pair<std::string, std::string>>{
             {folder.write("norole.ocio", no_role).string(), "the role aces_interchange is missing"},
             {folder.write("empty.ocio", "").string(), "OpenColorIO refuses this config"},
             {folder.write("cut.ocio", test::content(shipped).substr(0, 9000)).string(), "OpenColorIO refuses"},
             {folder.write("noise.ocio", std::string("\0\x01\xff{{[", 6)).string(), "OpenColorIO refuses"},
             {folder
                  .write("lut.ocio", std::regex_replace(test::content(shipped),
                                                        std::regex("!<BuiltinTransform> .style: ACEScct_to_ACES2065-1, "
                                                                   "direction: inverse."),
                                                        "!<FileTransform> {src: none.spi1d}"))
                  .string(),
              "OpenColorIO refuses"},
             {"/nonexistent.ocio", "no such OpenColorIO config"},
             {folder.path().string(), "no such OpenColorIO config"}}) {
        Result const r = check(folder, "--json --config " + path);
        INFO(path << ": " << r.error);
        CHECK(r.code == 2);
        CHECK(r.out.empty());
        CHECK_THAT(r.error, Contains(says));
    }
    CHECK(check(folder, "--nosuch").code == 2);
    CHECK_THAT(check(folder, "--help").out, Contains("3 a space is wrong"));
}
