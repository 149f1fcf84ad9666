// SPDX-License-Identifier: Apache-2.0
// Photon methods against `path`, against the furnace's closed form, and against themselves with other threads. They are
// biased: the bound of the bias is stated, and its sign is printed.
#include <fmt/format.h>
#include <catch2/catch.hpp>

#include "integrators/photon/photon_cache.h"
#include "support/same_bits.h"
#include "support/statistics.h"

using namespace iride;

namespace {

constexpr char const* view =
    R"("camera": { "eye": [0, 1.2, -4], "target": [0, 0.5, 0], "field_deg": 32 }, "film": { "size": [16, 16] },)";
constexpr char const* walls =
    R"({ "type": "quad", "corners": [[-2,0,-2],[-2,0,2],[2,0,2],[2,0,-2]], "material": { "type": "diffuse", "reflectance": 0.6 } },
       { "type": "quad", "corners": [[-2,0,2],[-2,3,2],[2,3,2],[2,0,2]], "material": { "type": "diffuse", "reflectance": { "rgb": [0.8, 0.3, 0.2], "space": "linear-sRGB" } } },
       { "type": "quad", "corners": [[-2,0,-2],[-2,3,-2],[-2,3,2],[-2,0,2]], "material": { "type": "diffuse", "reflectance": 0.7 } },)";
constexpr char const* lamp =
    R"({ "type": "quad", "corners": [[-0.6,2.5,-0.6],[0.6,2.5,-0.6],[0.6,2.5,0.6],[-0.6,2.5,0.6]], "material": { "type": "black" }, "emission": { "radiance": { "data": "D65", "luminance_weighted": 10 } } })";

std::string scene_text(std::string const& things) {
    return fmt::format(R"({{ {} "shapes": [ {} {} {} ] }})", view, walls, things, lamp);
}
std::string const diffuse_things =
    R"({ "type": "sphere", "centre": [0, 0.6, 0], "radius": 0.6, "material": { "type": "diffuse", "reflectance": 0.5 } },)";
std::string const glass_things =
    R"({ "type": "sphere", "centre": [0, 0.6, 0], "radius": 0.6, "material": { "type": "dielectric", "ior": { "data": "SF11", "outside": "extrapolate" } } },
       { "type": "quad", "corners": [[1,0,-1],[1,0,1],[1,1.5,1],[1,1.5,-1]], "material": { "type": "conductor", "ior": "Ag" } },)";

struct Difference {
    double mean;    // of Y, relative: the sign of the bias
    double relmse;  // against the reference, less the reference's own variance
};
Difference difference(Film const& a, Film const& b) {
    double sum_a = 0, sum_b = 0, relmse = 0;
    int const n = a.width() * a.height();
    for (int y = 0; y < a.height(); ++y)
        for (int x = 0; x < a.width(); ++x) {
            double const p = a.mean(x, y).Y, q = b.mean(x, y).Y;
            sum_a += p;
            sum_b += q;
            relmse += (square(p - q) - b.variance(x, y).Y) / (square(q) + 0.01) / n;
        }
    return {sum_a / sum_b - 1, relmse};
}

Film by(std::string const& integrator, Scene const& scene, int spp, std::uint64_t seed) {
    return test::rendered(scene, integrator, {.spp = spp, .seed = seed});
}

}  // namespace

TEST_CASE("progressive radii follow the product of their ratios", "[unit]") {
    double product = 1;
    for (int i = 1; i < 200; ++i) {
        CHECK(PhotonCache::shrinkage(i, 2.0 / 3) == Approx(product).epsilon(1e-10));
        product *= (i + 2.0 / 3) / (i + 1);
    }
}

// Every method inside a closed box of albedo .5 that emits 1 sees 1 / (1 - .5) everywhere. Fails for light counted
// twice or not at all between lamps, maps and gathering. The bound is that of one map's noise, .6 %: over 12 maps of
// 50000 photons the mean is -.1 +- .2 % off.
TEST_CASE("photon methods see the furnace's 2", "[law]") {
    auto const scene = load_scene(find_scene("cube-uniform"));
    scene->film.width = scene->film.height = 12;
    Film const reference = by("path", *scene, 256, 1);
    for (auto const& [name, bound] : {std::pair("photon-map:photons=100000,neighbours=60", 0.01),
                                      {"progressive-photon:photons=20000", 0.01},
                                      {"final-gather:photons=100000,neighbours=60", 0.01}}) {
        Difference const d = difference(by(name, *scene, 64, 2), reference);
        INFO(name << ": bias " << d.mean);
        CHECK(std::abs(d.mean) < bound);
    }
}

// Each kind of path is in one of lamps, caustic and indirect map, also where camera and photon are both dispersed; a
// final gather goes on through glass and mirrors. Fails for caustic photons in both maps.
TEST_CASE("photon methods are near path", "[law]") {
    for (auto const& things : {diffuse_things, glass_things}) {
        auto const scene = test::scene_from(scene_text(things));
        Film const reference = by("path", *scene, 4096, 1);
        for (auto const& [name, bound] : {std::pair("photon-map", 0.03), {"final-gather", 0.015}}) {
            Difference const d = difference(by(name, *scene, 256, 2), reference);
            WARN(fmt::format("{}: bias of the mean {:+.2f} %, relMSE {:.2g}", name, 100 * d.mean, d.relmse));
            CHECK(std::abs(d.mean) < bound);
        }
    }
}

// Metals of two widths of lobe, lit by a lamp, by a point through glass, and by one another. Fails for directions that
// are both followed and gathered, for those that are neither, for light of a point, which no path can meet, and for a
// photon's power that does not know how often its lamp is chosen.
TEST_CASE("photon methods are near path where narrow directions are followed", "[law]") {
    auto const scene = test::scene_from(fmt::format(
        R"({{ {} "shapes": [ {} {},
             {{ "type": "sphere", "centre": [-0.8, 0.5, 0], "radius": 0.5, "material": {{ "type": "conductor", "ior": "Au", "roughness": 0.05 }} }},
             {{ "type": "sphere", "centre": [0.5, 0.5, 0.3], "radius": 0.5, "material": {{ "type": "conductor", "ior": "Ag", "roughness": 0.3 }} }},
             {{ "type": "sphere", "centre": [0, 0.3, -1], "radius": 0.3, "material": {{ "type": "dielectric", "ior": 1.5 }} }} ],
             "lights": [ {{ "type": "point", "position": [0.3, 2, -1.4], "intensity": 2 }} ] }})",
        view, walls, lamp));
    Film const reference = by("bidirectional", *scene, 4096, 1);
    for (auto const& [name, bound] :
         {std::pair("photon-map", 0.03), {"final-gather", 0.015}, {"progressive-photon", 0.03}}) {
        Difference const d = difference(by(name, *scene, 256, 2), reference);
        WARN(fmt::format("{}: bias of the mean {:+.2f} %, relMSE {:.2g}", name, 100 * d.mean, d.relmse));
        CHECK(std::abs(d.mean) < bound);
    }
}

// With few photons a radius for the whole map is that of the floor, wider than the ball. Fails for it: 15 % dark.
TEST_CASE("progressive photons see a ball within glass as bright as it is after a few passes", "[law]") {
    auto const scene = test::scene_from(fmt::format(
        R"({{ {} "shapes": [ {}
             {{ "type": "sphere", "centre": [0, 0.6, 0], "radius": 0.6, "material": {{ "type": "dielectric", "ior": 1.5 }} }},
             {{ "type": "sphere", "centre": [0, 0.6, 0], "radius": 0.3, "material": {{ "type": "diffuse", "reflectance": 0.8 }} }},
             {} ] }})",
        R"("camera": { "eye": [0, 1.2, -4], "target": [0, 0.6, 0], "field_deg": 5 }, "film": { "size": [8, 8] },)",
        walls, lamp));
    Film const reference = by("bidirectional", *scene, 8192, 3);
    constexpr int renders = 64;
    double sum = 0, squares = 0;
    for (std::uint64_t seed = 0; seed < renders; ++seed) {
        double const bias = difference(by("progressive-photon:photons=4000", *scene, 16, seed), reference).mean;
        sum += bias, squares += bias * bias;
    }
    double const mean = sum / renders, error = std::sqrt((squares / renders - mean * mean) / renders);
    WARN(fmt::format("4 passes: bias {:+.2f} +- {:.2f} %", 100 * mean, 100 * error));
    CHECK(std::abs(mean) < 0.06);
    CHECK(error < 0.02);
}

// The expected square error of i passes falls as i^-alpha from the noise and i^-2(1-alpha) from the bias, both i^-2/3:
// 16 x the passes make it 6.3 x less; half of that is asked. Fails for a radius that stays, or that shrinks as a power
// of its own.
TEST_CASE("progressive photons converge to path", "[law]") {
    for (auto const& things : {diffuse_things, glass_things}) {
        auto const scene = test::scene_from(scene_text(things));
        Film const reference = by("path", *scene, 8192, 3);
        std::string const name = "progressive-photon:photons=4000";
        Difference const few = difference(by(name, *scene, 16, 4), reference),
                         many = difference(by(name, *scene, 256, 4), reference);
        WARN(fmt::format("4 passes: bias {:+.2f} %, relMSE {:.2g}; 64 passes: {:+.2f} %, {:.2g}", 100 * few.mean,
                         few.relmse, 100 * many.mean, many.relmse));
        CHECK(many.relmse < few.relmse / 3);
        CHECK(std::abs(many.mean) < 0.015);
    }
}

TEST_CASE("photon pictures are the same for any threads and tile order", "[law]") {
    auto const scene = test::scene_from(scene_text(glass_things));
    for (char const* name :
         {"photon-map:photons=5000", "progressive-photon:photons=2000", "final-gather:photons=5000"}) {
        INFO(name);
        CHECK((test::picture_values(*scene, name, 1, false) == test::picture_values(*scene, name, 7, true)));
    }
}

TEST_CASE("a final gather over radiosity is near path", "[law]") {
    auto const scene = test::scene_from(scene_text(diffuse_things));
    Film const reference = by("path", *scene, 4096, 1);
    Difference const d = difference(by("final-gather:source=radiosity", *scene, 256, 2), reference);
    WARN(fmt::format("bias of the mean {:+.2f} %, relMSE {:.2g}", 100 * d.mean, d.relmse));
    CHECK(std::abs(d.mean) < 0.02);
}

TEST_CASE("photons without a lamp or a surface to fall on are refused", "[input]") {
    auto const dark = test::scene_from(fmt::format(
        R"({{ {} "shapes": [ {{ "type": "sphere", "centre": [0,0,0], "radius": 1, "material": {{ "type": "diffuse", "reflectance": 0.5 }} }} ] }})",
        view));
    auto const mirrors = test::scene_from(fmt::format(
        R"({{ {} "shapes": [ {{ "type": "sphere", "centre": [0,0,0], "radius": 1, "material": {{ "type": "conductor", "ior": "Ag" }} }}, {} ] }})",
        view, lamp));
    for (char const* name : {"photon-map", "progressive-photon", "final-gather"}) {
        CHECK_THROWS_WITH(make_integrator(name, *dark, make_plan(*dark)), Catch::Contains("no lamp"));
        CHECK_THROWS_WITH(make_integrator(name, *mirrors, make_plan(*mirrors)),
                          Catch::Contains("no photon can be kept"));
    }
    CHECK_THROWS_WITH(make_integrator("photon-map:photon=9", *mirrors, make_plan(*mirrors)),
                      Catch::Contains("photons"));
}
