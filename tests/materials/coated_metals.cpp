// SPDX-License-Identifier: Apache-2.0
// The coated metal of a scene reflects what wave optics says of its stack.
#include <catch2/catch.hpp>

#include "materials/material.h"
#include "spectral/catalogue.h"
#include "support/scenes.h"

using namespace iride;

namespace {

ComplexIndex constant(double n, double k = 0) { return {SpectralFunction::constant(n), SpectralFunction::constant(k)}; }

// The index as the renderer has it, linear between whole nanometres: next to a knot of a table between them, narrow
// fringes move by as much as the resampled k does.
ComplexIndex on_grid(ComplexIndex const& index, WavelengthGrid const& grid) {
    if (index.n.is_constant()) return index;
    TabulatedShape n, k;
    for (int i = 0; i < grid.count; ++i) {
        double const nm = grid.first_nm + i;
        n.nm.push_back(nm), n.value.push_back(index.n.at(nm));
        k.nm.push_back(nm), k.value.push_back(index.k.at(nm));
    }
    return {SpectralFunction(n, Outside::hold), SpectralFunction(k, Outside::hold)};
}

}  // namespace

// Films to 10 um, whose fringes on silver near grazing incidence are narrower than .1 nm; twenty quarter waves. Seen to
// fail with half the phase.
TEST_CASE("a coating's lanes agree with wave optics in double precision", "[law]") {
    WavelengthGrid const grid = WavelengthGrid::covering(visible_range);
    ComplexIndex const silver = on_grid(load_complex_index("Ag"), grid);
    std::vector<CoatingLayer> quarter_waves;
    for (int i = 0; i < 10; ++i) {
        quarter_waves.push_back({constant(2.35), 58.5});
        quarter_waves.push_back({constant(1.46), 94.2});
    }
    WavelengthSampler const sampler(visible_range, SpectralFunction::constant(1), grid);
    struct Case {
        std::vector<CoatingLayer> layers;
        ComplexIndex metal;
    };
    for (Case const& c :
         {Case{{}, silver},
          Case{{{on_grid(load_complex_index("TiO2:Siefke"), grid), 25}}, on_grid(load_complex_index("Ti"), grid)},
          Case{{{constant(1.33), 300}}, on_grid(load_complex_index("Al"), grid)},
          Case{{{constant(1.38), 100}, {constant(2.3), 60}}, constant(1, 6)}, Case{{{constant(1.45), 5000}}, silver},
          Case{{{constant(1), 10000}}, silver}, Case{{{constant(2.3), 2000}, {constant(1.38), 3000}}, silver},
          Case{quarter_waves, silver}, Case{quarter_waves, constant(1.52)},
          Case{{{constant(1.6, 2), 1e7}}, constant(1.5)}, Case{{{constant(1.6, 2), 1e300}}, constant(1.5)}}) {
        CoatingTable const table(c.layers, c.metal, grid);
        INFO(c.layers.size() << " layers");
        double largest = 0;
        for (int i = 0; i < 2000; ++i) {
            Wavelengths const w = sampler.sample((static_cast<float>(i) + .5f) / 2000);
            float const cosine = square(static_cast<float>((i * 617) % 2000) / 1999);
            Lanes const R = CoatedFresnel{&table, table.row_of(w)}(cosine);
            for (int lane = 0; lane < lane_count; ++lane)
                largest =
                    std::max(largest, std::abs(static_cast<double>(R[lane]) -
                                               coated_reflectance(c.layers, c.metal, static_cast<double>(w.nm[lane]),
                                                                  static_cast<double>(cosine))));
        }
        CHECK(largest < coating_tolerance);
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
                    .margin(coating_tolerance)
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

// No oxide of iron is shipped: a constant 2.6 + .2i stands in for it. The colours of tempering follow the oxide: straw,
// where blue is missing, then purple, then blue, where red is.
TEST_CASE("tempered steel turns from straw to blue as its oxide grows", "[law]") {
    ComplexIndex const iron = load_complex_index("Fe"), oxide = constant(2.6, .2);
    auto const ratio = [&](double thickness) {  // red over blue
        std::vector<CoatingLayer> const film{{oxide, thickness}};
        return coated_reflectance(film, iron, 650, 1) / coated_reflectance(film, iron, 450, 1);
    };
    CHECK(ratio(0) == Approx(1.07).margin(.05));
    CHECK(ratio(20) > 2);   // straw
    CHECK(ratio(50) < .5);  // blue
}

// A layer of half a wave of silica leaves silver at its own reflectance where it is designed for, and takes little away
// elsewhere.
TEST_CASE("a protected silver mirror reflects as silver does at its design wavelength", "[law]") {
    ComplexIndex const silver = load_complex_index("Ag"), silica = load_complex_index("SiO2:Malitson");
    double const design = 550;
    std::vector<CoatingLayer> const film{{silica, design / (2 * silica.n.at(design))}};
    CHECK(coated_reflectance(film, silver, design, 1) ==
          Approx(coated_reflectance({}, silver, design, 1)).epsilon(1e-12));
    for (double nm = 450; nm <= 750; nm += 10) CHECK(coated_reflectance(film, silver, nm, 1) > .93);
}

// Against the bare metal's own quadrature, and for no layers at all.
TEST_CASE("the mean reflectance of a coating is that of its substance where the coating is none", "[unit]") {
    WavelengthGrid const grid = WavelengthGrid::covering(visible_range);
    for (ComplexIndex const& metal : {constant(.2, 3), constant(1.1, 6.7), constant(1.5)})
        for (std::vector<CoatingLayer> const& none : {std::vector<CoatingLayer>{}, {{constant(1.6), 0}}})
            CHECK(CoatingTable(none, metal, grid).mean_reflectance(140) ==
                  Approx(mean_fresnel(metal.n.at(500), metal.k.at(500))).epsilon(1e-3));
}
