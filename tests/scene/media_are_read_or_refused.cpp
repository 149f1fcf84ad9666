// SPDX-License-Identifier: Apache-2.0
// Media of scene files that scatter: what cannot be, or cannot be followed, is refused before rendering.
#include <catch2/catch.hpp>

#include "support/scenes.h"

using namespace iride;
using Catch::Matchers::Contains;

namespace {

std::string with(std::string const& rest) {
    return R"({ "camera": { "eye": [0,0,-5], "target": [0,0,0], "field_deg": 40 },
                "shapes": [ { "type": "sphere", "centre": [0,0,0], "radius": 1, "material": { "type": "diffuse", "reflectance": 0.5 }, "emission": { "radiance": 1 } } ], )" +
           rest + "}";
}
std::string refusal(std::string const& rest, std::string const& integrator = "path") {
    try {
        auto const scene = test::scene_from(with(rest));
        make_integrator(integrator, *scene, make_plan(*scene));
    } catch (InputError const& e) {
        return e.what();
    }
    return "(accepted)";
}
std::string body(std::string const& keys) {
    return R"("materials": { "milk": { "type": "dielectric", "ior": 1.33, )" + keys + " } }";
}

}  // namespace

TEST_CASE("coefficients below 0 and asymmetries of 1 are refused", "[input]") {
    CHECK_THAT(refusal(body(R"("scattering_per_m": -1)")), Contains("materials.milk.scattering_per_m"));
    CHECK_THAT(refusal(body(R"("scattering_per_m": { "pairs": [[400, 1], [700, -0.5]] })")),
               Contains("scattering_per_m"));
    CHECK_THAT(refusal(body(R"("scattering_per_m": 1, "asymmetry": 1)")), Contains("-0.999 .. 0.999"));
    CHECK_THAT(refusal(body(R"("scattering_per_m": 1, "asymmetry": -1.5)")), Contains("materials.milk.asymmetry"));
    CHECK_THAT(refusal(body(R"("asymmetry": 0.5)")), Contains("nothing scatters here"));
    CHECK_THAT(refusal(R"("medium": { "scattering_per_m": -1, "absorption_per_m": 1 })"),
               Contains("medium.scattering_per_m"));
    CHECK_THAT(refusal(R"("medium": { "absorption_per_m": -1 })"), Contains("medium.absorption_per_m"));
    CHECK_THAT(refusal(R"("medium": { "scatering_per_m": 1 })"), Contains("did you mean 'scattering_per_m'?"));
    CHECK_THAT(
        refusal(R"("materials": { "a": { "type": "slab", "ior": 1.5, "thickness": 0.01, "scattering_per_m": 1 } })"),
        Contains("scattering_per_m"));
    CHECK(refusal(body(R"("scattering_per_m": 1, "asymmetry": 0.9)")) == "(accepted)");
}
TEST_CASE("scattering without end is refused", "[input]") {
    CHECK_THAT(refusal(R"("medium": { "scattering_per_m": 1, "absorption_per_m": 0.001 })"),
               Contains("fills all space") && Contains("render.max_bounces"));
    CHECK(refusal(R"("medium": { "scattering_per_m": 1, "absorption_per_m": 0.01 })") == "(accepted)");
    CHECK(refusal(R"("medium": { "scattering_per_m": 1 }, "render": { "max_bounces": 10 })") == "(accepted)");
}
TEST_CASE("integrators that cannot follow light through media say so", "[input]") {
    std::string const haze = R"("medium": { "scattering_per_m": 1, "absorption_per_m": 0.1 })";
    CHECK_THAT(refusal(haze, "radiosity"), Contains("'radiosity' knows no medium") && Contains("'path'"));
    CHECK_THAT(refusal(R"("medium": { "absorption_per_m": 0.1 })", "radiosity"), Contains("knows no medium"));
    CHECK(refusal(haze, "reference_path") == "(accepted)");
}
TEST_CASE("light from infinity that a medium keeps out is told", "[input]") {
    std::string const haze = R"("medium": { "scattering_per_m": 1, "absorption_per_m": 0.1 }, )";
    auto const scene = test::scene_from(with(haze + R"("lights": [ { "type": "environment", "radiance": 1 } ])"));
    REQUIRE(scene->remarks.size() == 1);
    CHECK_THAT(scene->remarks[0], Contains("medium") && Contains("infinitely far"));
}
