// SPDX-License-Identifier: Apache-2.0
// The program as a user meets it: exit codes, messages, files written whole or not at all.
#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "support/files.h"
#include "support/program.h"
#include "support/scenes.h"

using namespace iride;
using Catch::Matchers::Contains;
using test::content;

namespace {

test::RunResult run(std::string const& arguments) { return test::run_iride(arguments); }

}  // namespace

TEST_CASE("render writes an EXR with its attributes, a preview and a report", "[app]") {
    test::TemporaryFolder const folder;
    std::string const base = (folder.path() / "a").string();
    test::RunResult const r = run("render metals --size 32x18 --spp 4 -o " + base + ".exr --preview " + base +
                                  ".png --report " + base + ".json");
    INFO(r.text);
    REQUIRE(r.code == 0);
    CHECK_THAT(r.text, Contains("camera paths/s") && Contains("% of the time in Embree"));
    CHECK(content(base + ".png").substr(1, 3) == "PNG");
    auto const report = nlohmann::json::parse(content(base + ".json"));
    CHECK(report["spp"] == 4);
    CHECK(report["rejected"]["not_finite"] == 0);
    XyzPicture const picture = read_exr_as_xyz(base + ".exr");
    CHECK(picture.xyz.width == 32);
    CHECK(picture.variance.width == 32);
}

TEST_CASE("every output space holds the same XYZ", "[app]") {
    test::TemporaryFolder const folder;
    auto const file = [&](std::string const& name) { return (folder.path() / (name + ".exr")).string(); };
    REQUIRE(run("render metals-furnace --size 16x16 --spp 4 --colourspace XYZ -o " + file("XYZ")).code == 0);
    XyzPicture const xyz = read_exr_as_xyz(file("XYZ"));
    for (std::string space : {"ACEScg", "ACES2065-1", "linear-sRGB", "Rec2020", "DisplayP3", "AdobeRGB"}) {
        REQUIRE(run("render metals-furnace --size 16x16 --spp 4 --colourspace " + space + " -o " + file(space)).code ==
                0);
        INFO(space);
        CHECK(compare(read_exr_as_xyz(file(space)), xyz).rmse < 1e-5);
    }
    test::RunResult const same = run("compare --json " + file("ACEScg") + " " + file("XYZ"));
    CHECK(nlohmann::json::parse(same.text)["relmse"].get<double>() < 1e-9);
}

TEST_CASE("an output that cannot be written is refused before any work, exit code 2", "[input]") {
    test::TemporaryFolder const folder;
    test::RunResult r = run("render metals --size 8x8 --spp 1 -o /nonexistent-folder/a.exr");
    CHECK(r.code == 2);
    CHECK_THAT(r.text, Contains("the folder '/nonexistent-folder' does not exist"));
    r = run("render metals --size 8x8 --spp 1 -o " + folder.path().string());
    CHECK(r.code == 2);
    std::filesystem::create_directory(folder.path() / "dir.exr");
    r = run("render metals --size 8x8 --spp 1 -o " + (folder.path() / "dir.exr").string());
    CHECK(r.code == 2);
    CHECK_THAT(r.text, Contains("it is a folder"));
}

// As root, the program is run as nobody (user 65534), whom permissions bind.
TEST_CASE("an output folder without permission to write is refused, exit code 2", "[input]") {
    test::TemporaryFolder const folder;
    namespace fs = std::filesystem;
    fs::permissions(folder.path(),
                    fs::perms::owner_read | fs::perms::owner_exec | fs::perms::others_read | fs::perms::others_exec);
    bool const root = ::geteuid() == 0;
    std::string const as_user = root ? "setpriv --reuid 65534 --regid 65534 --clear-groups " : "";
    bool const possible = test::run_command(as_user + IRIDE_PROGRAM " scenes").code == 0;
    if (possible) {
        auto const r = test::run_command(as_user + IRIDE_PROGRAM " render metals --size 8x8 --spp 1 -o " +
                                         (folder.path() / "a.exr").string());
        CHECK(r.code == 2);
        CHECK_THAT(r.text, Contains("is not writable: Permission denied"));
    } else {
        WARN("skipped: another user cannot run the program from this folder");
    }
    fs::permissions(folder.path(), fs::perms::owner_all);
    CHECK(test::file_count(folder.path()) == 0);
}

TEST_CASE("bad input leaves an existing output untouched", "[input]") {
    test::TemporaryFolder const folder;
    std::string const out = folder.write("a.exr", "precious").string(), bad = folder.write("bad.json", "{}").string();
    test::RunResult const r = run("render " + bad + " -o " + out);
    CHECK(r.code == 2);
    CHECK_THAT(r.text, Contains("the key 'camera' is missing"));
    for (char const* rest :
         {R"("shapes": [{ "type": "mesh", "file": "no.ply", "material": { "type": "black" } }])",
          R"("materials": { "a": { "type": "diffuse", "reflectence": 1 } })", R"("film": { "size": [0, 9] })",
          R"("lights": [{ "type": "environment", "image": "no.exr" }])"}) {
        folder.write(
            "bad.json",
            std::string(R"({ "camera": { "eye": [0,0,-5], "target": [0,0,0], "field_deg": 40 }, )") + rest + " }");
        INFO(rest);
        auto const refused = test::run_command("(" IRIDE_PROGRAM " render " + bad + " -o " + out + " 2>/dev/null)");
        CHECK(refused.code == 2);
        CHECK(refused.text.empty());  // nothing on stdout
    }
    CHECK(content(out) == "precious");
    CHECK(test::file_count(folder.path()) == 2);
}

TEST_CASE("wrong options are refused with exit code 2", "[input]") {
    for (char const* arguments :
         {"", "rendr metals", "render", "render nosuchscene", "render metals --size 0x4", "render metals --size 4by4",
          "render metals --spp 0", "render metals --colourspace sRGGB", "render metals --integrator bdpt",
          "render metals --nosuch 1", "render metals --spp 4 --time 3", "render metals -o a.png",
          "render metals --preview a.exr --size 8x8", "compare a.exr", "compare /nonexistent.exr /nonexistent.exr"}) {
        test::RunResult const r = run(arguments);
        INFO(arguments << ": " << r.text);
        CHECK(r.code == 2);
        CHECK(r.text.size() > 10);
    }
    CHECK_THAT(run("render metals --colourspace ACESgc").text, Contains("did you mean 'ACEScg'?"));
    CHECK_THAT(run("render metals --size 8x8 --spp 1 --preview /tmp/x.png --view Nice -o /tmp/x.exr").text,
               Contains("unknown view 'Nice'") && Contains("ACES SDR"));
}

TEST_CASE("Ctrl-C saves what is there and exits with 130", "[app]") {
    test::TemporaryFolder const folder;
    std::string const out = (folder.path() / "a.exr").string();
    test::RunResult const r =
        run("render cornell --size 64x64 --time 600 -o " + out + " & p=$!; sleep 2; kill -INT $p; wait $p");
    INFO(r.text);
    CHECK(r.code == 130);
    CHECK(read_exr_as_xyz(out).xyz.width == 64);
}

TEST_CASE("truncated and damaged EXR files are refused, never crash", "[input]") {
    test::TemporaryFolder const folder;
    std::string const out = (folder.path() / "a.exr").string();
    REQUIRE(run("render metals --size 16x16 --spp 1 -o " + out).code == 0);
    std::string const whole = content(out);
    for (std::size_t length = 0; length < whole.size(); length += 97) {
        auto const path = folder.write("cut.exr", whole.substr(0, length));
        CHECK_THROWS_AS(read_exr_as_xyz(path), InputError);
    }
    for (std::uint32_t i = 0; i < 300; ++i) {
        std::string damaged = whole;
        damaged[hash_words(i) % damaged.size()] = static_cast<char>(hash_words(i, 1u));
        auto const path = folder.write("bad.exr", damaged);
        try {
            read_exr_as_xyz(path);
        } catch (InputError const&) {
        }
    }
}
