// SPDX-License-Identifier: Apache-2.0
// `iride bench`: what it refuses, and that its numbers are whole. How fast anything is, no test says.
#include <catch2/catch.hpp>
#include <cmath>
#include <fstream>

#include "bench/measure/benchmark.h"
#include "support/program.h"
#include "support/scenes.h"

using namespace iride;
using Catch::Matchers::Contains;

TEST_CASE("bench refuses what is neither a benchmark nor a scene, and outputs that cannot be", "[input]") {
    auto const refused = [](std::string const& arguments, std::string const& message) {
        test::RunResult const r = test::run_iride("bench " + arguments);
        CHECK(r.code == 2);
        CHECK_THAT(r.text, Contains(message));
    };
    refused("eror", "did you mean 'error'?");
    refused("start cornel", "did you mean 'cornell'?");
    refused("start --json /nonexistent/a.json", "/nonexistent");
    refused("start --plot a.txt", ".png");
    refused("error --integrator nonsense", "unknown integrator 'nonsense'");
    refused("start --rounds 0", "--rounds");
}

// cube-uniform is 2 everywhere: the reference cannot be far from it. Fails if a half of a reference has the other's
// seed: its error would be 0.
TEST_CASE("bench tells errors by a reference that knows its own", "[law]") {
    test::TemporaryFolder const folder;
    std::string const json = (folder.path() / "a.json").string();
    test::RunResult const r =
        test::run_iride("bench error cube-uniform --integrator path --seconds 0.2 --reference-seconds 0.1 --json " +
                        json + " --references " + folder.path().string());
    INFO(r.text);
    REQUIRE(r.code == 0);
    auto const rows = nlohmann::json::parse(std::ifstream(json))["error"];
    REQUIRE(rows.size() == 1);
    CHECK(rows[0]["reference_relmse"].get<double>() > 0);
    CHECK(rows[0]["reference_relmse"].get<double>() < rows[0]["points"][0]["relmse"].get<double>());
    CHECK(rows[0]["points"].size() >= 1);
}

TEST_CASE("a power law is fitted and solved exactly where points lie on one", "[unit]") {
    std::vector<std::pair<double, double>> points;
    for (double const x : {1.0, 2.0, 4.0, 8.0}) points.emplace_back(x, 3 * std::pow(x, -1.5));
    bench::PowerLaw const law = bench::fit_power_law(points);
    CHECK(law.slope == Approx(-1.5));
    CHECK(law.scale == Approx(3));
    CHECK(law.x_at(3 * std::pow(16.0, -1.5)) == Approx(16));
}
