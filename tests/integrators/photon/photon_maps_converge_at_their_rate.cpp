// SPDX-License-Identifier: Apache-2.0
// A map of n photons of power Phi / n, spread over discs of k photons each, r^2 = k Phi / (n pi E): the variance is
// about (4 / 3) / k of the square, for the kernel 2 (1 - t^2) / pi. A disc of one radius for all photons around a point
// makes a bias of (r^2 / 8) laplacian(E) where the irradiance E bends, the mean over it; radii of the photons' own make
// laplacian(r^2 E) / 12, of a constant, which is none [Abramson 1982]. With k as n^(2/3) the mean square error goes as
// n^(-2/3).
#include <fmt/format.h>

#include <catch2/catch.hpp>
#include <numeric>

#include "support/agreement.h"

using namespace iride;

namespace {

constexpr double rho = 0.8, spot_height = 0.4, spot_z = -1, wall_z = 1, picture_z = -0.5;
constexpr double window = 0.25;  // half the picture's width
double const half_angle = 7 * pi_double / 180;
constexpr int pixels = 16;

// A wide floor, seen where its edges are far away, lit by the light of a wall alone, on which a narrow beam falls. Two
// scatterings, so that all that a floor pixel has is in the map.
std::string const lit_by_a_wall = fmt::format(
    R"({{ "camera": {{ "type": "orthographic", "eye": [0,3,{z}], "target": [0,0,{z}], "up": [0,0,1], "window": {window} }},
  "film": {{ "size": [{pixels}, {pixels}] }}, "render": {{ "max_bounces": 2 }},
  "materials": {{ "white": {{ "type": "diffuse", "reflectance": {rho} }} }},
  "shapes": [
    {{ "type": "quad", "material": "white", "corners": [[-4,0,-4],[-4,0,4],[4,0,4],[4,0,-4]] }},
    {{ "type": "quad", "material": "white", "corners": [[-1,0.01,1],[-1,1.5,1],[1,1.5,1],[1,0.01,1]] }} ],
  "lights": [ {{ "type": "spot", "position": [0,0.4,-1], "target": [0,0.4,1], "intensity": 1, "cone_deg": 7, "full_deg": 7 }} ] }})",
    fmt::arg("z", picture_z), fmt::arg("window", window), fmt::arg("pixels", pixels), fmt::arg("rho", rho));

double const solid_angle = 2 * pi_double * (1 - std::cos(half_angle));  // of the beam, of intensity 1: its power

// Irradiance of the floor by midpoints over the beam.
double irradiance(double x, double z) {
    constexpr int steps = 24;
    double sum = 0;
    for (int i = 0; i < steps; ++i) {
        double const cosine = 1 - (i + 0.5) / steps * (1 - std::cos(half_angle));
        double const reach = (wall_z - spot_z) * std::sqrt(1 / square(cosine) - 1);
        for (int j = 0; j < steps; ++j) {
            double const phi = 2 * pi_double * (j + 0.5) / steps;
            double const wall_x = reach * std::cos(phi), wall_y = spot_height + reach * std::sin(phi), d = wall_z - z;
            sum += wall_y * d / square(square(wall_x - x) + square(wall_y) + square(d));
        }
    }
    return rho / pi_double * sum * solid_angle / (steps * steps);
}
double laplacian(double x, double z) {
    constexpr double h = 0.02;  // m
    return (irradiance(x + h, z) + irradiance(x - h, z) + irradiance(x, z + h) + irradiance(x, z - h) -
            4 * irradiance(x, z)) /
           square(h);
}
double place(int pixel) { return ((pixel + 0.5) / pixels - 0.5) * 2 * window; }

// Of the picture's mean, relative, for k / n = 1.
double bias_per_share() {
    double excess = 0, sum = 0;
    for (int i = 0; i < pixels * pixels; ++i) {
        double const x = place(i % pixels), z = picture_z + place(i / pixels), e = irradiance(x, z);
        excess += solid_angle / (8 * pi_double) * laplacian(x, z) / e;
        sum += e;
    }
    return excess / sum;
}

Image<double> floor_radiance() {
    Image<double> radiance(pixels, pixels);
    for (int y = 0; y < pixels; ++y)
        for (int x = 0; x < pixels; ++x)
            radiance.at(x, y) = rho / pi_double * irradiance(place(x), picture_z - place(y));
    return radiance;
}

// Over independent maps.
struct Error {
    double square;  // mean over pixels of the relative mean square error
    double bias;    // of the picture's mean, relative
    double noise;   // of that bias
};
struct Step {
    int photons, neighbours, maps;
};
Error error_of(Scene const& scene, Step const& step, Image<double> const& truth) {
    auto const& [photons, neighbours, maps] = step;
    Error e{};
    double const n = pixels * pixels, sum = std::accumulate(truth.pixel.begin(), truth.pixel.end(), 0.0);
    test::Replicated const mean = test::replicated(maps, [&](int i) {
        Film const film = test::rendered(scene, fmt::format("photon-map:photons={},neighbours={}", photons, neighbours),
                                         {.spp = 32, .seed = 40 + static_cast<std::uint64_t>(i)});
        for (int y = 0; y < pixels; ++y)
            for (int x = 0; x < pixels; ++x)
                e.square += square(film.mean(x, y).Y / truth.at(x, y) - 1) / (n * step.maps);
        return test::picture_mean(film)[1].mean * n / sum - 1;
    });
    e.bias = mean.mean;
    e.noise = mean.error;
    return e;
}

}  // namespace

// Fails for the k nearest photons of a point, whose bias is that of a disc's mean.
TEST_CASE("a photon map's error falls as its photons to the -2/3 and it has no bias of a disc's mean", "[law]") {
    auto const scene = test::scene_from(lit_by_a_wall);
    Image<double> const truth = floor_radiance();
    auto const oracle = test::picture_mean(test::rendered(*scene, "bidirectional", {.spp = 256, .seed = 3}))[1];
    double const mean = std::accumulate(truth.pixel.begin(), truth.pixel.end(), 0.0) / (pixels * pixels);
    CHECK(std::abs(oracle.mean - mean) < 4 * std::sqrt(oracle.variance));
    CHECK(std::sqrt(oracle.variance) < 0.01 * mean);

    std::vector<Error> errors;
    double share = 0, weights = 0;  // of a disc's bias
    for (Step const& step : {Step{2000, 20, 320}, {5000, 63, 120}, {20000, 159, 60}, {80000, 400, 24}}) {
        Error const e = errors.emplace_back(error_of(*scene, step, truth));
        double const expected = bias_per_share() * step.neighbours / step.photons;
        std::string const result =
            fmt::format("{} photons, {} neighbours: relMSE {:.2g}, bias {:+.2f} % +- {:.2f} %, of a disc {:+.2f} %",
                        step.photons, step.neighbours, e.square, 100 * e.bias, 100 * e.noise, 100 * expected);
        INFO(result);
        WARN(result);
        double const weight = square(expected / e.noise);
        share += weight * e.bias / expected;
        weights += weight;
    }
    INFO("share of a disc's bias: " << share / weights << " +- " << 1 / std::sqrt(weights));
    CHECK(std::abs(share / weights) < 3.5 / std::sqrt(weights));
    CHECK(1 / std::sqrt(weights) < 0.2);
    // From the second on. Each is known to a tenth: dozens of maps of a field with some independent places.
    for (std::size_t i : {2u, 3u})
        CHECK(errors[i - 1].square / errors[i].square == Approx(std::pow(4, 2.0 / 3)).epsilon(0.25));
}
