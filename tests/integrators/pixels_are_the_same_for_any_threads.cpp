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

// Of every integrator there is: threads, tile order, passes, a stop in the middle, and a crop where there can be one.
TEST_CASE("every integrator's pictures are the same bits for any threads, tile order, passes and stops", "[law]") {
    for (IntegratorEntry const& e : integrator_entries()) {
        std::string const name = e.name, text = name.find("photon") != std::string::npos || name == "final-gather"
                                                    ? name + ":photons=3000"
                                                    : name;
        auto const scene =
            load_scene(find_scene(name == "auto" || name == "caustic-path" ? "cornell-gold" : "cornell"));
        scene->film.width = 37;
        scene->film.height = 29;
        scene->film.band_count = 3;
        INFO(name);
        auto const one = test::picture_values(*scene, text, 1, false);
        CHECK((test::picture_values(*scene, text, 2, false) == one));
        CHECK((test::picture_values(*scene, text, 5, true) == one));
        CHECK((test::picture_values(*scene, text, 3, true, true) == one));

        RenderPlan const plan = make_plan(*scene);
        Film film = make_film(*scene);
        for (int spp : {3, 8})
            render(*scene, plan, *make_integrator(text, *scene, plan), {.spp = spp, .seed = 5}, film);
        CHECK((test::values_of(film) == one));

        if (make_integrator(text, *scene, plan)->splats()) continue;
        Film part = make_film(*scene, Crop{10, 7, 31, 20});
        render(*scene, plan, *make_integrator(text, *scene, plan), {.spp = 8, .seed = 5}, part);
        bool same = true;
        for (int y = 0; y < part.height(); ++y)
            for (int x = 0; x < part.width(); ++x) {
                Xyz const a = part.mean(x, y), b = film.mean(x + 10, y + 7);
                same = same && a.X == b.X && a.Y == b.Y && a.Z == b.Z;
            }
        CHECK(same);
    }
}
