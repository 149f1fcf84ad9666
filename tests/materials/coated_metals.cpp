// SPDX-License-Identifier: Apache-2.0
// The coated metal of a scene reflects what wave optics says of its stack.
#include <catch2/catch.hpp>

#include "materials/material.h"
#include "spectral/catalogue.h"
#include "support/scenes.h"

using namespace iride;

namespace {

ComplexIndex constant(double n, double k = 0) { return {SpectralFunction::constant(n), SpectralFunction::constant(k)}; }

}  // namespace

// The tolerance is the table's own, once for each of its directions.
TEST_CASE("the table of a coating is right to a thousandth", "[law]") {
    WavelengthGrid const grid = WavelengthGrid::covering(visible_range);
    WavelengthSampler const sampler(visible_range, SpectralFunction::constant(1), grid);
    struct Case {
        std::vector<CoatingLayer> layers;
        ComplexIndex metal;
    };
    for (Case const& c :
         {Case{{}, load_complex_index("Ag")}, Case{{{load_complex_index("TiO2:Siefke"), 25}}, load_complex_index("Ti")},
          Case{{{load_complex_index("TiO2:Siefke"), 150}}, load_complex_index("Ti")},
          Case{{{constant(1.38), 100}, {constant(2.3), 60}}, load_complex_index("Al")},
          Case{{{constant(1.6, 2), 1e7}}, constant(1.5)}}) {
        CoatingTable const table(c.layers, c.metal, grid);
        INFO(table.rows() << " x " << table.columns());
        double largest = 0;
        for (int i = 0; i < 200; ++i) {
            Wavelengths const w = sampler.sample((static_cast<float>(i) + .5f) / 200);
            float const cosine = static_cast<float>((i * 61) % 200) / 199;
            Lanes const R = CoatedFresnel{&table, table.row_of(w)}(cosine);
            for (int lane = 0; lane < lane_count; ++lane)
                largest =
                    std::max(largest, std::abs(static_cast<double>(R[lane]) -
                                               coated_reflectance(c.layers, c.metal, static_cast<double>(w.nm[lane]),
                                                                  static_cast<double>(cosine))));
        }
        CHECK(largest < 2 * coating_tolerance);
    }
}

// Fails with the layers read from inside to outside.
TEST_CASE("a coated mirror of a scene file reflects its stack", "[law]") {
    auto const scene = test::scene_from(
        R"({ "camera": { "eye": [0,0,-5], "target": [0,0,0], "field_deg": 40 }, "materials": { "mirror": { "type":
             "conductor", "ior": "Ag", "coating": [ { "ior": "SiO2:Malitson", "thickness_nm": 90 },
             { "ior": { "n": 2.4, "k": 0.1 }, "thickness_nm": 40 } ] } } })");
    std::vector<CoatingLayer> const layers{{load_complex_index("SiO2:Malitson"), 90}, {constant(2.4, .1), 40}};
    ComplexIndex const silver = load_complex_index("Ag");
    Material const& material = *scene->materials.back().material;
    CHECK(!material.traits.has_density);
    Wavelengths const w = WavelengthSampler(visible_range, SpectralFunction::constant(1), scene->grid).sample(.3f);
    for (float cosine : {1.f, .7f, .2f, .01f}) {
        Direction const wo(std::sqrt(1 - cosine * cosine), 0, cosine);
        auto const s = material.at({}, w).sample(wo, {.5f, {.5f, .5f}});
        REQUIRE(s);
        CHECK(!s->density);
        for (int lane = 0; lane < lane_count; ++lane)
            CHECK(
                static_cast<double>(s->weight[lane]) ==
                Approx(coated_reflectance(layers, silver, static_cast<double>(w.nm[lane]), static_cast<double>(cosine)))
                    .margin(2 * coating_tolerance)
                    .epsilon(0));
    }
}

// Titanium under a growing oxide runs through straw, purple and blue, as anodisers know it: the minimum of reflectance
// moves from the blue to the red. A film whose phase is halved gets there at twice the thickness.
TEST_CASE("anodised titanium turns from straw to blue as its oxide grows", "[law]") {
    auto const darkest_nm = [](double thickness) {
        std::vector<CoatingLayer> const oxide{{load_complex_index("TiO2:Siefke"), thickness}};
        ComplexIndex const titanium = load_complex_index("Ti");
        double best = 0, least = 2;
        for (double nm = 380; nm <= 780; nm += 5)
            if (double const R = coated_reflectance(oxide, titanium, nm, 1); R < least) best = nm, least = R;
        return best;
    };
    CHECK(darkest_nm(22) < 450);  // blue is missing: straw
    CHECK(darkest_nm(50) > 600);  // red is missing: blue
}
