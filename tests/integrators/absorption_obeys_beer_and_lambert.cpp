// SPDX-License-Identifier: Apache-2.0
// Rendered from scene files: light that went d metres through a body is exp(-sigma_a d) of what it was. A pane of it,
// with F and t of a face and a crossing: T = (1 - F)^2 t / (1 - F^2 t^2).
#include <catch2/catch.hpp>

#include "materials/fresnel.h"
#include "spectral/catalogue.h"
#include "support/transparent_scenes.h"

using namespace iride;

namespace {

double normal_F(double n) { return square((n - 1) / (n + 1)); }
double transmitted(double F, double t) { return square(1 - F) * t / (1 - square(F * t)); }

void check_colour(std::string const& text, Xyz const& wanted, int spp, double largest_error) {
    auto const scene = test::scene_from(text);
    CHECK(make_plan(*scene).media);
    for (char const* integrator : {"path", "reference_path"}) {
        Film const film =
            test::rendered(*scene, integrator, {.spp = spp, .seed = 21, .sampler = SamplerKind::independent});
        auto const [mean, error] = test::measured(film);
        INFO(integrator << ": " << mean.X << " " << mean.Y << " " << mean.Z << ", wanted " << wanted.X << " "
                        << wanted.Y << " " << wanted.Z);
        CHECK(film.rejected() == std::array<std::uint64_t, rejection_count>{});
        constexpr double level = 4.5, rounding = 2e-6;  // 1e-4 over all the checks of this file, two-sided
        CHECK(std::abs(mean.X - wanted.X) < level * error.X + rounding);
        CHECK(std::abs(mean.Y - wanted.Y) < level * error.Y + rounding);
        CHECK(std::abs(mean.Z - wanted.Z) < level * error.Z + rounding);
        CHECK(error.Y < largest_error);
    }
}

std::string const plastic =
    R"("glass": { "type": "dielectric", "ior": 2.5, "absorption_per_m": { "pairs": [[360,0.2],[600,2],[830,0.5]] } })";
double sigma_a(double nm) { return nm < 600 ? .2 + 1.8 * (nm - 360) / 240 : 2 - 1.5 * (nm - 600) / 230; }

}  // namespace

// Fails where the way to an inner face does not absorb but the way to an outer one does, and where a path is absorbed
// but once.
TEST_CASE("a pane of coloured glass transmits the closed form of all orders", "[law]") {
    double const F = normal_F(2.5), d = .7;
    Xyz const wanted = test::colour_of([&](double nm) { return transmitted(F, std::exp(-sigma_a(nm) * d)); });
    check_colour(test::through_to_wall(0, plastic, test::wide_box("glass", 0, d)), wanted, 1 << 15, 1e-3);
}

// Fails for a crossing along the normal.
TEST_CASE("light that crosses a pane at an angle is absorbed along its refracted path", "[law]") {
    double const d = .7, s = std::sin(radians(60.)) / 2.5;
    double const F = fresnel(std::cos(radians(60.)), 2.5, 0.0).unpolarised(), way = d / std::sqrt(1 - s * s);
    Xyz const wanted = test::colour_of([&](double nm) { return transmitted(F, std::exp(-sigma_a(nm) * way)); });
    check_colour(test::through_to_wall(60, plastic, test::wide_box("glass", 0, d)), wanted, 1 << 15, 1e-3);
}

// Fails for 2 pi k / lambda, the decay of the amplitude.
TEST_CASE("five metres of water are as blue as Hale and Querry's k", "[law]") {
    ComplexIndex const water = load_complex_index("H2O:Hale");
    Xyz const wanted = test::colour_of([&](double nm) {
        return transmitted(normal_F(water.n.at(nm)), std::exp(-4 * pi_double * water.k.at(nm) / (nm * 1e-9) * 4.9));
    });
    CHECK(wanted.Z > 1.2 * wanted.X);
    check_colour(test::through_to_wall(0, R"("water": { "type": "dielectric", "ior": "H2O:Hale" })",
                                       test::wide_box("water", 0, 4.9)),
                 wanted, 1 << 15, 2e-3);
}

// With n = 1 there is no surface, and no chance but that of the wavelengths.
TEST_CASE("a colour at a distance is that colour at that distance", "[law]") {
    std::string text = test::through_to_wall(
        0,
        R"("wine": { "type": "dielectric", "ior": 1, "absorption": { "transmittance": { "rgb": [0.6, 0.1, 0.2], "space": "linear-sRGB" }, "distance": 2 } })",
        test::wide_box("wine", 0, 2));
    std::string const white = R"("radiance": 1)";
    text.replace(text.find(white), white.size(), R"("radiance": { "data": "D65", "luminance_weighted": 1 })");
    auto const scene = test::scene_from(text.insert(1, R"( "length_unit_m": 0.1, )"));
    auto const [mean, error] = test::measured(test::rendered(*scene, "path", {.spp = 1 << 12, .seed = 4}));
    // The matrix of IEC 61966-2-1.
    CHECK(mean.X == Approx(.4124 * .6 + .3576 * .1 + .1805 * .2).margin(1e-3).epsilon(0));
    CHECK(mean.Y == Approx(.2126 * .6 + .7152 * .1 + .0722 * .2).margin(1e-3).epsilon(0));
    CHECK(mean.Z == Approx(.0193 * .6 + .1192 * .1 + .9505 * .2).margin(1e-3).epsilon(0));
}

// A point light of intensity I, r from a floor of reflectance rho and straight above the point that is seen from h:
//   L = rho / pi I / r^2 exp(-sigma_a (r + h)).
// All of it inside a body of n = 1. Fails when light samples are not absorbed, and when the camera is taken to be
// outside.
TEST_CASE("a lamp, a floor and a camera inside a body see each other through it", "[law]") {
    double const r = .8, h = 1.5, sigma = .7;
    for (std::string const priority : {"", R"(, "priority": 3)"}) {
        auto const scene = test::scene_from(fmt::format(
            R"({{ "camera": {{ "type": "orthographic", "eye": [0,{},0], "target": [0,0,0], "up": [0,0,1], "window": 1e-3 }}, "film": {{ "size": [2,2] }},
                 "materials": {{ "fog": {{ "type": "dielectric", "ior": 1, "absorption_per_m": {} {} }} }},
                 "shapes": [ {{ "type": "sphere", "centre": [0,0,0], "radius": 5, "material": "fog" }},
                             {{ "type": "disc", "centre": [0,0,0], "normal": [0,1,0], "radius": 0.5, "material": {{ "type": "diffuse", "reflectance": 0.4 }} }} ],
                 "lights": [ {{ "type": "point", "position": [0,{},0], "intensity": 3 }} ] }})",
            h, sigma, priority, r));
        double const wanted = .4 / pi_double * 3 / square(r) * std::exp(-sigma * (r + h));
        for (char const* integrator : {"path", "reference_path"}) {
            auto const [mean, error] = test::measured(test::rendered(*scene, integrator, {.spp = 1 << 12, .seed = 6}));
            INFO(integrator << priority);
            CHECK(mean.Y == Approx(wanted).margin(4.5 * error.Y + 2e-6).epsilon(0));
            CHECK(error.Y < 1e-3 * wanted);
        }
    }
}
