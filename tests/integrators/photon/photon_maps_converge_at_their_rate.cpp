// SPDX-License-Identifier: Apache-2.0
// A map of n photons of which the k nearest are gathered, over radius r: r^2 goes as k / n. The variance is 1 / k of
// the square, and the bias, where the irradiance E bends, (r^2 / 8) laplacian(E): the disc's mean over E less E. With k
// as n^(2/3) both parts of the mean square error go as n^(-2/3) [Silverman 1986, ch. 4]: eight times the photons
// and four times the neighbours make a quarter of it.
#include <fmt/format.h>

#include <catch2/catch.hpp>

#include "support/agreement.h"

using namespace iride;

namespace {

// A wide floor, seen where its edges are far away, lit by the light of a wall alone: the lamp behind the wall's foot
// shines upwards. Two scatterings, so that all that a floor pixel has beyond what it gets from the lamp is in the map.
std::string const lit_by_a_wall = R"({
  "camera": { "type": "orthographic", "eye": [0,3,0], "target": [0,0,0], "up": [0,0,1], "window": 0.5 },
  "film": { "size": [16, 16] }, "render": { "max_bounces": 2 },
  "materials": { "white": { "type": "diffuse", "reflectance": 0.8 }, "black": { "type": "black" } },
  "shapes": [
    { "type": "quad", "material": "white", "corners": [[-4,0,-4],[-4,0,4],[4,0,4],[4,0,-4]] },
    { "type": "quad", "material": "white", "corners": [[-1,0.2,1],[-1,1.5,1],[1,1.5,1],[1,0.2,1]] },
    { "type": "quad", "material": "black", "corners": [[-1,0.1,0.9],[1,0.1,0.9],[1,0.1,0.7],[-1,0.1,0.7]],
      "emission": { "radiance": 20 } } ] })";

struct Error {
    double square;  // mean over pixels of the relative mean square error
    double bias;    // of the picture's mean, relative
    double noise;   // of that bias
};
// Over independent maps.
Error error_of(Scene const& scene, int photons, int neighbours, Film const& reference) {
    constexpr int maps = 12;
    Error e{};
    double const n = reference.width() * reference.height(), truth = test::picture_mean(reference)[1].mean;
    test::Replicated const mean = test::replicated(maps, [&](int i) {
        Film const film = test::rendered(scene, fmt::format("photon-map:photons={},neighbours={}", photons, neighbours),
                                         {.spp = 32, .seed = 40 + static_cast<std::uint64_t>(i)});
        for (int y = 0; y < film.height(); ++y)
            for (int x = 0; x < film.width(); ++x) {
                double const p = film.mean(x, y).Y, q = reference.mean(x, y).Y;
                e.square += square(p / q - 1) / (n * maps);
            }
        return test::picture_mean(film)[1].mean / truth - 1;
    });
    e.bias = mean.mean;
    e.noise = mean.error;
    return e;
}

}  // namespace

TEST_CASE("a photon map's error falls as its photons to the -2/3, and its bias is that of a disc's mean", "[.long]") {
    auto const scene = test::scene_from(lit_by_a_wall);
    Film const reference = test::rendered(*scene, "path", {.spp = 16384, .seed = 3});
    std::vector<Error> errors;
    for (int step = 0; step < 3; ++step) {
        int const photons = 20000 << 3 * step, neighbours = 200 << 2 * step;
        Error const e = errors.emplace_back(error_of(*scene, photons, neighbours, reference));
        WARN(fmt::format("{} photons, {} neighbours: relMSE {:.2g}, bias {:+.2f} % +- {:.2f} %", photons, neighbours,
                         e.square, 100 * e.bias, 100 * e.noise));
    }
    for (std::size_t i : {1u, 2u}) {
        // Mean square errors over a dozen maps of a field with some ten independent places are known to a tenth.
        CHECK(errors[i - 1].square / errors[i].square == Approx(4).epsilon(0.25));
        // Light that falls off from a wall bends upwards: a disc sees too much of it.
        CHECK(errors[i - 1].bias > 3 * errors[i - 1].noise);
        CHECK(errors[i].bias < errors[i - 1].bias);
    }
}
