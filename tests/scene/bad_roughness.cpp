// SPDX-License-Identifier: Apache-2.0
// Roughnesses that no surface has are refused, with the place, what was found and what is allowed.
#include <catch2/catch.hpp>

#include "support/scenes.h"

using namespace iride;
using Catch::Matchers::Contains;

namespace {

std::string refusal(std::string const& keys, std::string const& type = R"("type": "conductor", "ior": "Au")") {
    try {
        test::scene_from(
            R"({ "camera": { "eye": [0,0,-5], "target": [0,0,0], "field_deg": 40 }, "materials": { "m": { )" + type +
            ", " + keys + " } } }");
    } catch (InputError const& e) {
        return e.what();
    }
    return "(accepted)";
}

}  // namespace

TEST_CASE("roughness out of its range is refused", "[input]") {
    for (std::string const found : {"-0.1", "1.5", "0.0005", "[0.1, 0]", "[0.1, 2]"})
        CHECK_THAT(refusal("\"roughness\": " + found),
                   Contains("materials.m.roughness: found") && Contains("allowed: 0 (smooth), 0.001 .. 1"));
    CHECK_THAT(refusal(R"("roughness": [0.1, 0.2, 0.3])"), Contains("materials.m.roughness"));
    CHECK_THAT(refusal(R"("roughness": "rough")"), Contains("materials.m.roughness"));
    CHECK_THAT(refusal(R"("roughness": 3)", R"("type": "dielectric", "ior": 1.5)"), Contains("found 3, allowed"));
    CHECK(refusal(R"("roughness": [0.001, 1], "rotation_deg": -30)") == "(accepted)");
    CHECK(refusal(R"("roughness": 0.001)", R"("type": "dielectric", "ior": 1.5)") == "(accepted)");
}
TEST_CASE("mixtures of facets must be whole", "[input]") {
    CHECK_THAT(refusal(R"("facets": [ { "weight": 0.5, "roughness": 0.1 }, { "weight": 0.4, "roughness": 0.3 } ])"),
               Contains("materials.m.facets: the weights sum to 0.9, allowed: 1"));
    CHECK_THAT(refusal(R"("facets": [ { "weight": 1, "roughness": 0 } ])"),
               Contains("materials.m.facets[0].roughness: found 0, allowed: 0.001 .. 1"));
    CHECK_THAT(refusal(R"("facets": [ { "weight": 1 } ])"), Contains("materials.m.facets[0]") && Contains("roughness"));
    CHECK_THAT(refusal(R"("facets": [ { "weight": -1, "roughness": 0.1 } ])"), Contains("facets[0].weight: found -1"));
    CHECK_THAT(refusal(R"("facets": [ { "weight": 1, "rougness": 0.1 } ])"), Contains("did you mean 'roughness'?"));
    CHECK_THAT(refusal(R"("facets": [])"), Contains("an array of 1 .. 8 roughnesses is wanted"));
    CHECK_THAT(refusal(R"("roughness": 0.1, "facets": [ { "weight": 1, "roughness": 0.1 } ])"),
               Contains("the roughness is given twice"));
}
TEST_CASE("unknown distributions and maskings are refused", "[input]") {
    CHECK_THAT(refusal(R"("roughness": 0.1, "distribution": "bekmann")"), Contains("did you mean 'beckmann'?"));
    CHECK_THAT(refusal(R"("roughness": 0.1, "masking": "smit")"), Contains("did you mean 'smith'?"));
}
