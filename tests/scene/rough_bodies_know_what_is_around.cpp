// SPDX-License-Identifier: Apache-2.0
// A rough body with a priority is prepared for every medium that may lie around it. In a furnace of L / n^2 a lossless
// surface is not seen: the density of scattered directions, f cos times n_i^2 / n_o^2, integrates to 1 from either
// side.
#include <catch2/catch.hpp>

#include "support/quadrature.h"
#include "support/scenes.h"

using namespace iride;

namespace {

// int of the density of the hero over all directions; two-point Gauss rule in the angle, midpoint in azimuth.
double integral_of_density(Bsdf const& bsdf, Direction const& wo) {
    constexpr int rows = 128, columns = 128;
    double const gauss = 0.5 / std::sqrt(3.0);
    double sum = 0;
    for (int i = 0; i < 2 * rows; ++i)
        for (double side : {-gauss, gauss})
            for (int j = 0; j < columns; ++j) {
                double const x = (i + 0.5 + side) / rows * 90;
                Direction const wi = test::at_angle(x, 2 * pi_double * (j + 0.5) / columns);
                sum += static_cast<double>(bsdf.evaluate(wo, wi).density[0]) * std::sin(radians(x));
            }
    return sum * square(pi_double) / (2.0 * rows * columns);
}

}  // namespace

// Fails for facets prepared for vacuum alone: .52 .. 1.30.
TEST_CASE("a rough body conserves energy in every medium of its scene", "[law]") {
    auto const scene = test::scene_from(R"({ "camera": { "eye": [0,0,-4], "target": [0,0,0], "field_deg": 30 },
        "materials": { "water": { "type": "dielectric", "ior": 1.33, "roughness": 0.8, "priority": 1 },
                       "glass": { "type": "dielectric", "ior": 1.33, "priority": 2 },
                       "flint": { "type": "dielectric", "ior": { "pairs": [[300, 1.85], [900, 1.7]] }, "priority": 3 },
                       "diamond": { "type": "dielectric", "ior": 2.4, "roughness": 1, "priority": 4 } },
        "shapes": [ { "type": "sphere", "centre": [0,0,0], "radius": 1, "material": "water" } ] })");
    Wavelengths const w = wavelengths_at(LaneRegister{} + 550, scene->grid);
    for (NamedMaterial const& rough : scene->materials) {
        if (!rough.material->traits.has_density) continue;
        for (NamedMaterial const& around : scene->materials) {
            Lanes const n = around.material->body()->inside.n.at(w), own = rough.material->body()->inside.n.at(w);
            if (n[0] == own[0]) continue;  // hardly a boundary: light goes straight on, between the rule's points
            for (double angle : {0., 40., 75., 105., 150.}) {
                double const all =
                    integral_of_density(rough.material->at_boundary({}, w, n), test::at_angle(angle, 0.4));
                INFO(rough.name << " in " << around.name << " at " << angle << ": " << all);
                CHECK(std::abs(all - 1) < 5e-3);
            }
        }
    }
}
