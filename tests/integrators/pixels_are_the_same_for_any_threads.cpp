// SPDX-License-Identifier: Apache-2.0
// A pixel is a function of (scene, seed, spp) alone: not of the number of threads, the order of tiles, or
// the passes in which the samples come, which decide what paths are followed together.
#include <catch2/catch.hpp>

#include "support/same_bits.h"

using namespace iride;

// Fails for a sampler that goes on from pixel to pixel, and for a film whose pixels are filled by two threads at once.
TEST_CASE("any threads, tile order and passes give the same bits, with dispersion and bands too", "[law]") {
    for (char const* name : {"cornell-gold", "prism", "metals", "box-plaster-copper-glass", "glass-of-cordial"}) {
        auto const scene = load_scene(find_scene(name));
        scene->film.width = 70;  // neither side is a multiple of the tile's
        scene->film.height = 50;
        scene->film.band_count = 7;
        auto const picture = [&](int threads, bool reversed, bool doubling_passes = false) {
            return test::picture_values(*scene, "path", threads, reversed, doubling_passes);
        };
        INFO(name);
        RenderPlan const plan = make_plan(*scene);
        bool const nested = std::string(name) == "glass-of-cordial";
        bool const dispersive =
            nested || std::string(name) == "prism" || std::string(name) == "box-plaster-copper-glass";
        CHECK(plan.dispersion == dispersive);
        CHECK(plan.media == nested);
        auto const one = picture(1, false);
        CHECK((picture(2, false) == one));
        CHECK((picture(5, false) == one));
        CHECK((picture(1, true) == one));
        CHECK((picture(5, true) == one));
        CHECK((picture(1, false, true) == one));
    }
}
