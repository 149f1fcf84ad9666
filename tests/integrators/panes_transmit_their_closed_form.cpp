// SPDX-License-Identifier: Apache-2.0
// A window of one quad, from the scene file to the film.
#include <catch2/catch.hpp>

#include "materials/fresnel.h"
#include "support/transparent_scenes.h"

using namespace iride;

namespace {

std::string const medium = R"("ior": 2, "absorption_per_m": 0.8)";

test::Measured seen_through(double angle, std::string const& type_and_keys, std::string const& shape) {
    auto const scene =
        test::scene_from(test::through_to_wall(angle, "\"pane\": { " + type_and_keys + medium + " }", shape));
    return test::measured(
        test::rendered(*scene, "path", {.spp = 1 << 15, .seed = 12, .sampler = SamplerKind::independent}));
}

}  // namespace

// T of each polarisation is (1 - F)^2 t / (1 - F^2 t^2).
TEST_CASE("a window of one quad dims the wall behind it by both polarisations' closed form", "[law]") {
    for (double angle : {0., 60.}) {
        double const s = std::sin(radians(angle)) / 2, t = std::exp(-.8 * .5 / std::sqrt(1 - s * s));
        auto const F = fresnel(std::cos(radians(angle)), 2.0, 0.0);
        auto const T = [&](double f) { return square(1 - f) * t / (1 - square(f * t)); };
        auto const [mean, error] =
            seen_through(angle, R"("type": "slab", "thickness": 0.5, )",
                         R"({ "type": "quad", "corners": [[-9,-9,1],[9,-9,1],[9,9,1],[-9,9,1]], "material": "pane" })");
        INFO(angle << ": " << mean.Y << " +- " << error.Y);
        CHECK(mean.Y == Approx((T(F.s) + T(F.p)) / 2).margin(4.5 * error.Y).epsilon(0));
        CHECK(error.Y < 1e-3);
    }
}

TEST_CASE("straight through, a pane of one quad is as bright as the same pane of two faces", "[law]") {
    auto const thin =
        seen_through(0, R"("type": "slab", "thickness": 0.5, )",
                     R"({ "type": "disc", "centre": [0,0,1], "normal": [0,0,1], "radius": 9, "material": "pane" })");
    auto const thick = seen_through(0, R"("type": "dielectric", )", test::wide_box("pane", 1, 1.5));
    CHECK(std::abs(thin.mean.Y - thick.mean.Y) < 4.5 * std::hypot(thin.error.Y, thick.error.Y));
}
