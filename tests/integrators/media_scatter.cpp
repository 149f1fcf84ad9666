// SPDX-License-Identifier: Apache-2.0
// Media that scatter, rendered from scene files, against what must hold whatever they are and against integrals that
// are worked out another way.
#include <catch2/catch.hpp>

#include "integrators/plan_disable.h"
#include "support/transparent_scenes.h"

using namespace iride;

namespace {

// Looks along z from -3; what is there is told by the rest.
std::string looking(std::string const& rest, std::string const& render = "") {
    return fmt::format(
        R"({{ "camera": {{ "type": "orthographic", "eye": [0,0,-3], "target": [0,0,0], "window": 1e-3 }},
             "film": {{ "size": [4,4] }}, "render": {{ "sampler": "independent"{} }}, {} }})",
        render, rest);
}
std::string const wall =
    R"({ "type": "quad", "corners": [[-400,-400,5],[-400,400,5],[400,400,5],[400,-400,5]], "material": { "type": "black" }, "emission": { "radiance": 1 } })";
std::string const hundredfold = R"({ "pairs": [[360, 0.02], [830, 2]] })";

void check_colour(Xyz const& found, Xyz const& wanted, Xyz const& error, double bias) {
    constexpr double level = 4;  // standard errors: 6e-5, two-sided
    CHECK(found.X == Approx(wanted.X).margin(level * error.X + bias).epsilon(0));
    CHECK(found.Y == Approx(wanted.Y).margin(level * error.Y + bias).epsilon(0));
    CHECK(found.Z == Approx(wanted.Z).margin(level * error.Z + bias).epsilon(0));
}

}  // namespace

// Without scattered light (no bounce) 8 m leave exp(-(sigma_a + sigma_s) 8).
TEST_CASE("what comes straight through haze is what it neither absorbs nor scatters", "[law]") {
    auto const scene = test::scene_from(looking(
        R"("medium": { "absorption_per_m": 0.03, "scattering_per_m": { "pairs": [[360, 0.005], [830, 0.5]] } }, "shapes": [)" +
            wall + "]",
        R"(, "max_bounces": 0)"));
    Xyz const wanted = test::colour_of([](double nm) { return std::exp(-8 * (.03 + .005 + (nm - 360) / 470 * .495)); });
    for (char const* integrator : {"path", "reference_path"}) {
        auto const [mean, error] = test::measured(test::rendered(*scene, integrator, {.spp = 1 << 13, .seed = 4}));
        INFO(integrator);
        check_colour(mean, wanted, error, 1e-5);
        CHECK(error.Y < .01 * wanted.Y);
    }
}

namespace {

// A ball without a boundary of its own, in an evenly bright sky.
std::string cloud(std::string const& sigma_s, double g) {
    return fmt::format(
        R"("shapes": [ {{ "type": "sphere", "centre": [0,0,0], "radius": 1, "material": {{ "type": "dielectric", "ior": 1, "scattering_per_m": {}, "asymmetry": {} }} }} ],
           "lights": [ {{ "type": "environment", "radiance": 1 }} ])",
        sigma_s, g);
}

// The largest Y that a packet can bring of a radiance whose lanes are 1 in the mean: all of it in one lane, where
// ybar / p is largest.
double largest_sample(Scene const& scene) {
    WavelengthSampler const sampler = make_wavelength_sampler(scene, make_plan(scene));
    Observer const& eye = cie1931_2deg();
    double most = 0;
    for (int i = 0; i < 4096; ++i) {
        Wavelengths const w = sampler.sample((static_cast<float>(i) + .5f) / 4096);
        for (int k = 0; k < lane_count; ++k)
            most = std::max(most, eye.at(static_cast<double>(w.nm[k])).Y / static_cast<double>(w.density[k]));
    }
    return most / eye.ybar_integral;
}

}  // namespace

// With albedo 1 a packet's lanes are 1 in the mean, whatever their extinctions: no sample is above M, of mean 1, so the
// variance of a sample is at most M - 1.
TEST_CASE("a cloud that absorbs nothing disappears in a furnace, and no sample is a firefly", "[law]") {
    for (auto const& [sigma_s, g] : {std::pair(std::string("3"), 0.), {hundredfold, .8}, {hundredfold, -.5}}) {
        auto const scene = test::scene_from(looking(cloud(sigma_s, g)));
        double const M = largest_sample(*scene);
        for (char const* integrator : {"path", "reference_path"}) {
            Film const film = test::rendered(*scene, integrator, {.spp = 1 << 11, .seed = 5});
            auto const [mean, error] = test::measured(film);
            INFO(integrator << " g " << g << " M " << M);
            CHECK(film.rejected() == std::array<std::uint64_t, rejection_count>{});
            check_colour(mean, {1, 1, 1}, error, 1e-4);
            for (int i = 0; i < 16; ++i) CHECK(film.variance(i % 4, i / 4).Y * (1 << 11) < M - 1);
        }
    }
}

// In a closed room whose walls emit 1 and reflect half, radiance is 2 everywhere, with or without haze: lamps are
// sampled at walls and in the haze.
TEST_CASE("haze that absorbs nothing does not change an even room", "[law]") {
    auto const scene =
        test::scene_from(looking(R"("medium": { "scattering_per_m": )" + hundredfold + R"(, "asymmetry": 0.4 },
           "shapes": [ { "type": "box", "min": [-2,-2,-4], "max": [2,2,3], "flip": true, "material": { "type": "diffuse", "reflectance": 0.5 }, "emission": { "radiance": 1 } } ])",
                                 R"(, "max_bounces": 9000)"));
    for (char const* integrator : {"path", "reference_path"}) {
        auto const [mean, error] = test::measured(test::rendered(*scene, integrator, {.spp = 1 << 12, .seed = 7}));
        INFO(integrator);
        check_colour(mean, {2, 2, 2}, error, 2e-4);
        CHECK(error.Y < .01);
    }
}

namespace {

std::string haze(double sigma_s, double g) {
    return fmt::format(R"("medium": {{ "scattering_per_m": {}, "absorption_per_m": 0.05, "asymmetry": {} }})", sigma_s,
                       g);
}

double henyey_greenstein(double g, double cosine) {
    return (1 - g * g) / (4 * pi_double) / std::pow(1 + g * g - 2 * g * cosine, 1.5);
}

}  // namespace

// Light that is scattered once, from a lamp of intensity I at the distance h beside the ray, at z = 0, along the ray
// from -3 to a black wall at 5: L = int sigma_s p(angle) I / r^2 exp(-sigma_t (z + 3 + r)) dz.
TEST_CASE("the air glows beside a lamp as the integral along the ray says", "[law]") {
    double const h = .7, I = 4, sigma_s = .11, sigma_t = .11 + .05;
    for (double const g : {0., .6, -.4}) {
        auto const scene = test::scene_from(looking(
            fmt::format(
                R"({}, "shapes": [ {{ "type": "quad", "corners": [[-40,-40,5],[-40,40,5],[40,40,5],[40,-40,5]], "material": {{ "type": "black" }} }} ],
                   "lights": [ {{ "type": "point", "position": [0,{},0], "intensity": {} }} ])",
                haze(sigma_s, g), h, I),
            R"(, "max_bounces": 1)"));
        double wanted = 0;
        constexpr int steps = 100000;
        for (int i = 0; i < steps; ++i) {
            double const z = -3 + 8 * (i + .5) / steps, r = std::hypot(h, z);
            // Light travels from the lamp to z, then to -z.
            double const cosine = -z / r;
            wanted +=
                8. / steps * sigma_s * henyey_greenstein(g, cosine) * I / (r * r) * std::exp(-sigma_t * (z + 3 + r));
        }
        for (char const* integrator : {"path", "reference_path"}) {
            auto const [mean, error] = test::measured(test::rendered(*scene, integrator, {.spp = 1 << 13, .seed = 9}));
            INFO(integrator << " g " << g);
            check_colour(mean, {wanted, wanted, wanted}, error, 1e-5);
            CHECK(error.Y < .02 * wanted);
        }
    }
}

namespace {

Film rendered_without_beams(Scene& scene, RenderSettings const& settings) {
    RenderPlan const plan = make_plan_without({"beams"}, scene);
    Film film = make_film(scene);
    render(scene, plan, *make_integrator("path", scene, plan), settings, film);
    return film;
}

}  // namespace

// The same of a spot that shines across the ray, 6 degrees about -y: lit is where |z| < h tan 6 degrees. Few flights
// end there; equal angles about the lamp all do.
TEST_CASE("a shaft of light is as bright as its integral says, and hardly noisy", "[law]") {
    double const h = 2, I = 4, sigma_s = .11, sigma_t = .11 + .05, g = .5;
    auto const scene = test::scene_from(looking(
        fmt::format(
            R"({}, "shapes": [ {{ "type": "quad", "corners": [[-40,-40,5],[-40,40,5],[40,40,5],[40,-40,5]], "material": {{ "type": "black" }} }} ],
                   "lights": [ {{ "type": "spot", "position": [0,{},0], "target": [0,0,0], "cone_deg": 6, "full_deg": 6, "intensity": {} }} ])",
            haze(sigma_s, g), h, I),
        R"(, "max_bounces": 1)"));
    double wanted = 0;
    double const end = h * std::tan(radians(6.));
    constexpr int steps = 100000;
    for (int i = 0; i < steps; ++i) {
        double const z = end * (2 * (i + .5) / steps - 1), r = std::hypot(h, z);
        wanted +=
            2 * end / steps * sigma_s * henyey_greenstein(g, -z / r) * I / (r * r) * std::exp(-sigma_t * (z + 3 + r));
    }
    RenderSettings const settings{.spp = 1 << 10, .seed = 9};
    auto const [mean, error] = test::measured(test::rendered(*scene, "path", settings));
    check_colour(mean, {wanted, wanted, wanted}, error, 1e-5 * wanted);
    CHECK(error.Y < 2e-3 * wanted);
    auto const by_flight = test::measured(rendered_without_beams(*scene, settings));
    check_colour(by_flight.mean, {wanted, wanted, wanted}, by_flight.error, 1e-5 * wanted);
    CHECK(by_flight.error.Y > 20 * error.Y);
}

// A spot shines along a wall, 3 degrees about +x, two metres before it and a metre and a half aside. Of the wall, seen
// from a millimetre, L = rho / pi int sigma_s p(angle) I exp(-sigma_t (d + r)) cos / r^2 dd dw over the beam, up to
// where it meets the wall.
TEST_CASE("a wall glows beside a beam as the integral over the beam says", "[law]") {
    double const rho = .8, I = 4, sigma_s = .2, sigma_t = .25, g = .4, half_angle = radians(3.);
    auto const scene = test::scene_from(fmt::format(
        R"({{ "camera": {{ "type": "orthographic", "eye": [0,0,4.999], "target": [0,0,5], "window": 1e-3 }},
             "film": {{ "size": [4,4] }}, "render": {{ "sampler": "independent", "max_bounces": 2 }}, {},
             "shapes": [ {{ "type": "quad", "corners": [[-400,-400,5],[-400,400,5],[400,400,5],[400,-400,5]], "material": {{ "type": "diffuse", "reflectance": {} }} }} ],
             "lights": [ {{ "type": "spot", "position": [-2,1.5,3], "target": [0,1.5,3], "cone_deg": 3, "full_deg": 3, "intensity": {} }} ] }})",
        haze(sigma_s, g), rho, I));
    double wanted = 0;
    VectorDouble const lamp(-2, 1.5, 3), seen(0, 0, 5);
    constexpr int heights = 16, azimuths = 32, steps = 4000;
    double const height = 1 - std::cos(half_angle), solid_angle = 2 * pi_double * height / (heights * azimuths);
    for (int i = 0; i < heights; ++i)
        for (int j = 0; j < azimuths; ++j) {
            double const x = 1 - height * (i + .5) / heights, across = std::sqrt(1 - x * x),
                         turn = 2 * pi_double * (j + .5) / azimuths;
            VectorDouble const travel(x, across * std::cos(turn), across * std::sin(turn));
            double const end = travel.z() > 0 ? std::min(60., 2 / travel.z()) : 60;
            for (int k = 0; k < steps; ++k) {
                double const d = end * (k + .5) / steps;
                VectorDouble const to_viewer = seen - (lamp + d * travel);
                double const r = to_viewer.norm();
                wanted += rho / pi_double * solid_angle * end / steps * sigma_s *
                          henyey_greenstein(g, travel.dot(to_viewer) / r) * I * std::exp(-sigma_t * (d + r)) *
                          (to_viewer.z() / r) / (r * r);
            }
        }
    RenderSettings const settings{.spp = 1 << 11, .seed = 10};
    auto const [mean, error] = test::measured(test::rendered(*scene, "path", settings));
    check_colour(mean, {wanted, wanted, wanted}, error, 1e-3 * wanted);  // the millimetre before the wall
    CHECK(error.Y < .01 * wanted);
    auto const by_flight = test::measured(rendered_without_beams(*scene, settings));
    CHECK(by_flight.error.Y > 5 * error.Y);
}

// Two lamps in a closed room full of haze that absorbs, with a diffuse, a metal and a glass ball, up to four
// scatterings; the same in the open, from where paths hardly return; and a lamp in a ball of milk,
// of one colour and of many, that one with a surface inside which is none.
TEST_CASE("what is found along rays and beams is what flights find", "[law]") {
    std::string const lamps =
        R"("lights": [ { "type": "point", "position": [-0.8,0.6,0], "intensity": 3 },
                       { "type": "spot", "position": [0.9,1.7,0.4], "target": [0,-1,0.2], "cone_deg": 25, "full_deg": 15, "intensity": 30 } ])";
    std::string const balls =
        R"({ "type": "sphere", "centre": [0.7,-1,0], "radius": 0.5, "material": { "type": "diffuse", "reflectance": 0.7 } },
           { "type": "sphere", "centre": [-0.7,-1,0.8], "radius": 0.5, "material": { "type": "conductor", "ior": "Cu", "roughness": 0.3 } },
           { "type": "sphere", "centre": [0,0.4,1.5], "radius": 0.4, "material": { "type": "dielectric", "ior": 1.5 } } ])";
    std::string const room =
        R"({ "type": "box", "min": [-2,-2,-4], "max": [2,2,3], "flip": true, "material": { "type": "diffuse", "reflectance": 0.5 } }, )";
    std::string const milk =
        R"("shapes": [ { "type": "sphere", "centre": [0,0,0], "radius": 1, "material": { "type": "dielectric", "ior": 1.1, "scattering_per_m": 1, "asymmetry": 0.4 } } ],
           "lights": [ { "type": "point", "position": [0.3,0.2,-0.4], "intensity": 3 } ])";
    // Of the ball within, whose surface is none, nothing is seen.
    std::string const nested =
        R"("shapes": [ { "type": "sphere", "centre": [0,0,0], "radius": 1, "material": { "type": "dielectric", "ior": 1.1, "priority": 2, "scattering_per_m": )" +
        hundredfold + R"(, "asymmetry": 0.4 } },
                       { "type": "sphere", "centre": [0,0,0], "radius": 0.6, "material": { "type": "dielectric", "ior": 1.3, "priority": 1 } } ],
           "lights": [ { "type": "point", "position": [0.3,0.2,-0.4], "intensity": 3 } ])";
    struct Place {
        char const* name;
        std::string things;
    };
    for (auto const& [name, things] :
         {Place{"room", haze(.25, 0.3) + R"(, "shapes": [ )" + room + balls + ", " + lamps},
          Place{"open", haze(.25, 0.3) + R"(, "shapes": [ )" + balls + ", " + lamps}, Place{"milk", milk},
          Place{"nested", nested}}) {
        auto const scene = test::scene_from(fmt::format(
            R"({{ "camera": {{ "eye": [0,0,-3.5], "target": [0,0,0], "field_deg": 40 }}, "film": {{ "size": [8,8] }},
                 "render": {{ "sampler": "independent", "max_bounces": 4 }}, {} }})",
            things));
        RenderSettings const settings{.spp = 1 << 12, .seed = 12};
        auto const [mean, error] = test::measured(test::rendered(*scene, "path", settings));
        auto const by_flight = test::measured(rendered_without_beams(*scene, settings)),
                   reference = test::measured(test::rendered(*scene, "reference_path", settings));
        INFO(name);
        for (auto const& other : {by_flight, reference})
            check_colour(mean, other.mean,
                         {std::hypot(error.X, other.error.X), std::hypot(error.Y, other.error.Y),
                          std::hypot(error.Z, other.error.Z)},
                         0);
        CHECK(error.Y < .03 * mean.Y);
        CHECK(error.Y < .8 * by_flight.error.Y);
    }
}

namespace {

// Fluence at r free paths from a point that sends out 1, in endless fog of albedo c that scatters evenly, by singular
// eigenfunctions:
//   phi(r) = 1 / (4 pi r) (dK^2/dc exp(-K r) + int_0^1 exp(-r / mu) / g(mu) dmu / mu^2),   c artanh(K) / K = 1,
//   g = (1 - c mu artanh mu)^2 + (pi c mu / 2)^2,   dK^2/dc = 2 K^2 (1 - K^2) / (c (K^2 + c - 1))
//                                                                                    [Case 1953, ch. IV] [Case 1967]
double fluence_in_fog(double c, double r) {
    double low = 1e-9, high = 1 - 1e-15;
    for (int i = 0; i < 200; ++i) {
        double const K = (low + high) / 2;
        (c * std::atanh(K) / K < 1 ? low : high) = K;
    }
    double const K2 = low * low;
    double sum = 2 * K2 * (1 - K2) / (c * (K2 + c - 1)) * std::exp(-low * r);
    constexpr int steps = 20000;
    for (int i = 0; i < steps; ++i) {
        double const mu = (i + .5) / steps;
        double const g = std::pow(1 - c * mu * std::atanh(mu), 2) + std::pow(pi_double * c * mu / 2, 2);
        sum += std::exp(-r / mu) / (g * mu * mu) / steps;
    }
    return sum / (4 * pi_double * r);
}

}  // namespace

// What arrives from all directions but the lamp's own, without a wall anywhere. Paths go astray, and those that return
// must count for those that were given up.
TEST_CASE("endless fog around a lamp glows as transport theory says", "[law]") {
    double const c = .95, sigma_t = 2, r = 1.5;
    double absorbed = 0;  // light is conserved
    for (int i = 0; i < 4000; ++i) {
        double const x = (i + .5) / 100;
        absorbed += (1 - c) * fluence_in_fog(c, x) * 4 * pi_double * x * x / 100;
    }
    CHECK(absorbed == Approx(1).epsilon(1e-3));

    double const x = r * sigma_t, alone = std::exp(-x) / (4 * pi_double * x * x);
    double const wanted = square(sigma_t) * (fluence_in_fog(c, x) - alone);  // of a lamp that sends 4 pi
    auto const scene = test::scene_from(fmt::format(
        R"({{ "camera": {{ "eye": [0,0,{}], "target": [0,0,9], "field_deg": 10 }}, "film": {{ "size": [1,1] }},
             "medium": {{ "scattering_per_m": {}, "absorption_per_m": {} }}, "shapes": [],
             "lights": [ {{ "type": "point", "position": [0,0,0], "intensity": 1 }} ] }})",
        r, c * sigma_t, (1 - c) * sigma_t));
    for (char const* name : {"path", "reference_path"}) {
        RenderPlan const plan = make_plan(*scene);
        auto const integrator = make_integrator(name, *scene, plan);
        PathStarter const starter(*scene, plan, 1, 1, SamplerKind::independent, 21);
        Film film(1, 1, cie1931_2deg(), scene->grid);
        RayStatistics statistics;
        for (std::uint32_t i = 0; i < 1 << 17; ++i) {
            CameraPath path;
            starter.start(0, 0, i, path);
            path.ray.direction = to_sphere(Sampler(SamplerKind::independent, 22, 0, i).next2());
            integrator->follow(*scene, {&path, 1}, statistics);
            REQUIRE(path.complete);
            film.add(0, 0, path.wavelengths, path.radiance);
        }
        auto const [mean, error] = test::measured(film);
        INFO(name);
        check_colour(mean, {wanted, wanted, wanted}, error, 1e-4 * wanted);
        CHECK(error.Y < .03 * wanted);
    }
}

namespace {

double E1(double x) { return -std::expint(-x); }
double E2(double x) { return std::exp(-x) - x * E1(x); }

// A slab of optical thickness b and albedo a that scatters evenly, under even light of radiance 1 from the side t = 0:
//   S(t) = a / 2 (E_2(t) + int_0^b E_1(|t - s|) S(s) ds)
// by midpoints, the singular kernel integrated exactly over each cell: int E_1 = -E_2. Radiance along the normal.
struct Slab {
    double reflected = 0, transmitted = 0;
    Slab(double a, double b, int cells) {
        double const w = b / cells;
        Eigen::MatrixXd K(cells, cells);
        Eigen::VectorXd lit(cells);
        auto const below = [](double x) { return x > 0 ? 1 - E2(x) : x < 0 ? E2(-x) - 1 : 0; };  // int_0^x E_1(|s|) ds
        for (int i = 0; i < cells; ++i) {
            double const t = (i + .5) * w;
            lit[i] = a / 2 * E2(t);
            for (int j = 0; j < cells; ++j) K(i, j) = a / 2 * (below((j + 1) * w - t) - below(j * w - t));
        }
        Eigen::VectorXd const S = (Eigen::MatrixXd::Identity(cells, cells) - K).partialPivLu().solve(lit);
        transmitted = std::exp(-b);
        for (int i = 0; i < cells; ++i) {
            double const from = std::exp(-i * w), to = std::exp(-(i + 1) * w);
            reflected += S[i] * (from - to);
            transmitted += S[i] * (std::exp(-(b - (i + 1) * w)) - std::exp(-(b - i * w)));
        }
    }
};

}  // namespace

// The wall behind the slab is the light. From the other side it is seen in the light that comes back.
TEST_CASE("a milky slab reflects and transmits what its integral equation says", "[law]") {
    Slab const even(1, 2, 400);
    CHECK(even.reflected + even.transmitted == Approx(1).margin(1e-4));  // light is conserved
    for (auto const& [albedo, thickness] : {std::pair(1., 1.), {.8, 2.}, {.95, 4.}}) {
        Slab const slab(albedo, thickness, 400);
        for (bool const behind : {true, false}) {
            // Between 0 and 2; looked at from the lit side the camera is close, with the wall behind it.
            auto const scene = test::scene_from(fmt::format(
                R"({{ "camera": {{ "type": "orthographic", "eye": [0,0,{}], "target": [0,0,1], "window": 1e-3 }},
                     "film": {{ "size": [4,4] }}, "render": {{ "sampler": "independent" }},
                     "materials": {{ "milk": {{ "type": "dielectric", "ior": 1, "scattering_per_m": {}, "absorption_per_m": {} }} }},
                     "shapes": [ {}, {} ] }})",
                behind ? -3 : 4, albedo * thickness / 2, (1 - albedo) * thickness / 2, wall,
                test::wide_box("milk", 0, 2)));
            auto const [mean, error] = test::measured(test::rendered(*scene, "path", {.spp = 1 << 13, .seed = 10}));
            double const wanted = behind ? slab.transmitted : slab.reflected;
            INFO("albedo " << albedo << " thickness " << thickness << (behind ? " through" : " back"));
            check_colour(mean, {wanted, wanted, wanted}, error, 3e-4);  // of the light's and slab's ends
            CHECK(error.Y < .01 * wanted);
        }
    }
}
