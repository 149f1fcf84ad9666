// SPDX-License-Identifier: Apache-2.0
// A metal with a roughness map scatters at each point as the metal of that roughness does, energy and all.
#include <catch2/catch.hpp>

#include "materials/conductor_material.h"
#include "materials/roughness_mapped_conductor.h"
#include "materials/textures.h"

using namespace iride;

namespace {

WavelengthGrid const grid = WavelengthGrid::covering(visible_range);
// Gold, roughly: what matters is that it depends on wavelength.
ComplexIndex gold() {
    return {SpectralFunction(TabulatedShape{{360, 500, 600, 830}, {1.6, .9, .25, .15}}, Outside::hold),
            SpectralFunction(TabulatedShape{{360, 500, 600, 830}, {1.9, 1.8, 3, 5}}, Outside::hold)};
}

// Largest relative difference of values and densities over some pairs of directions.
double difference(Bsdf const& a, Bsdf const& b) {
    double most = 0;
    for (float polar_o : {.1f, .7f, 1.3f})
        for (float polar_i : {.05f, .6f, 1.2f})
            for (float azimuth : {.3f, 2.f, 3.1f}) {
                Direction const wo(std::sin(polar_o), 0, std::cos(polar_o));
                Direction const wi(std::sin(polar_i) * std::cos(azimuth), std::sin(polar_i) * std::sin(azimuth),
                                   std::cos(polar_i));
                BsdfEvaluation const x = a.evaluate(wo, wi), y = b.evaluate(wo, wi);
                for (int i = 0; i < lane_count; ++i) {
                    most = std::max(most, static_cast<double>(std::abs(x.value[i] / y.value[i] - 1)));
                    most = std::max(most, static_cast<double>(std::abs(x.density[i] / y.density[i] - 1)));
                }
            }
    return most;
}

ConductorMaterial metal(float roughness, bool multiple_scattering) {
    return {gold(), {Facets::ggx(roughness, roughness)}, multiple_scattering, grid};
}

}  // namespace

TEST_CASE("where the map says .3, the metal is that of roughness .3", "[unit]") {
    Wavelengths const w = WavelengthSampler(visible_range, visible_importance(), grid).sample(.4f);
    for (bool multiple : {true, false}) {
        RoughnessMappedConductor const mapped(gold(), ScalarMap(.3f), multiple, grid);
        ConductorMaterial const plain = metal(.3f, multiple);
        CHECK(difference(mapped.at({}, w), plain.at({}, w)) < (multiple ? 1e-3 : 1e-5));
    }
}

// Waves between .1 and .5: 55 roughnesses 3 % apart, so the nearest is within 1.5 %, which moves D by less than
// (2 + 4) 1.5 % where it falls steepest.
TEST_CASE("a varying roughness is rounded by 1.5 % at most", "[unit]") {
    Wavelengths const w = WavelengthSampler(visible_range, visible_importance(), grid).sample(.4f);
    RoughnessMappedConductor const mapped(gold(), ScalarMap(std::make_shared<Waves>(Vector2(1, 0)), .1f, .5f), true,
                                          grid);
    SurfacePoint point;
    for (float u : {0.f, .07f, .21f, .33f, .5f}) {
        point.uv = {u, 0};
        float const roughness = .3f + .2f * std::cos(2 * pi * u);
        CHECK(difference(mapped.at(point, w), metal(roughness, true).at({}, w)) < .09);
    }
}
