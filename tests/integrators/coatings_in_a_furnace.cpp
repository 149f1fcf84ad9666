// SPDX-License-Identifier: Apache-2.0
// Lossless films in an environment of radiance 1: every path sees 1, so that the picture is 1 everywhere.
#include <catch2/catch.hpp>

#include "support/scenes.h"

using namespace iride;

// A bubble in a bubble and a coated, dispersive lens: R and T of each lane, its share in the mixture of lanes, and
// refraction agree.
TEST_CASE("soap bubbles and coated lenses disappear in a furnace", "[law]") {
    auto const scene = test::scene_from(R"({
        "camera": { "type": "orthographic", "eye": [0,0,-10], "target": [0,0,0], "window": 2.2 },
        "film": { "size": [18, 6] }, "lights": [ { "type": "environment", "radiance": 1 } ],
        "materials": { "soap": { "type": "film", "layers": [ { "ior": 1.33, "thickness_nm": 700 } ] },
            "lens": { "type": "dielectric", "ior": "N-BK7",
                      "coating": [ { "ior": 1.38, "thickness_nm": 100 }, { "ior": 2.3, "thickness_nm": 400 } ] } },
        "shapes": [ { "type": "sphere", "material": "soap", "centre": [3,0,0], "radius": 1.4 },
                    { "type": "sphere", "material": "soap", "centre": [3,0,0], "radius": 1 },
                    { "type": "sphere", "material": "lens", "centre": [0,0,0], "radius": 1.4 } ] })");
    for (char const* integrator : {"path", "reference_path"}) {
        Film const film = test::rendered(*scene, integrator, {.spp = 512});
        int off = 0;
        for (int y = 0; y < film.height(); ++y)
            for (int x = 0; x < film.width(); ++x) {
                Xyz const mean = film.mean(x, y), variance = film.variance(x, y);
                off += std::abs(mean.Y - 1) > 3.3 * std::sqrt(variance.Y) + 1e-4;  // two-sided level 1e-3
                CHECK(std::abs(mean.Y - 1) < .05);
            }
        INFO(integrator);
        CHECK(off <= 4);
        for (std::uint64_t const n : film.rejected()) CHECK(n == 0);
    }
}
