// SPDX-License-Identifier: Apache-2.0
// In a closed room whose surfaces all reflect rho, lit by power Phi, the light that arrives after k scatterings is Phi
// rho^k: photons are stored Phi (rho + rho^2 + ...) = Phi rho / (1 - rho) in all, and what is absorbed of it and of the
// first arrival, (1 - rho) (Phi + Phi rho / (1 - rho)), is what was emitted.
#include <fmt/format.h>
#include <catch2/catch.hpp>

#include "integrators/photon/photon_tracer.h"
#include "support/scenes.h"

using namespace iride;

namespace {

// A cube of side 2 about (0, 1, 0); the ceiling's middle is a lamp of 1 m^2, radiance 1.
std::string room(double rho, std::string const& more = "") {
    std::string const walls = fmt::format(R"({{ "type": "diffuse", "reflectance": {} }})", rho);
    auto const quad = [&](std::string const& corners) {
        return fmt::format(R"({{ "type": "quad", "corners": {}, "material": {} }},)", corners, walls);
    };
    return R"({ "camera": { "eye": [0, 1, -0.9], "target": [0, 1, 0], "field_deg": 60 }, "film": { "size": [8, 8] }, "shapes": [)" +
           quad("[[-1,0,-1],[-1,0,1],[1,0,1],[1,0,-1]]") + quad("[[-1,2,-1],[1,2,-1],[1,2,1],[-1,2,1]]") +
           quad("[[-1,0,-1],[1,0,-1],[1,2,-1],[-1,2,-1]]") + quad("[[-1,0,1],[-1,2,1],[1,2,1],[1,0,1]]") +
           quad("[[-1,0,-1],[-1,2,-1],[-1,2,1],[-1,0,1]]") + quad("[[1,0,-1],[1,0,1],[1,2,1],[1,2,-1]]") + more +
           fmt::format(
               R"({{ "type": "quad", "corners": [[-0.5,1.99,-0.5],[0.5,1.99,-0.5],[0.5,1.99,0.5],[-0.5,1.99,0.5]],
                 "material": {}, "emission": {{ "radiance": 1 }} }} ] }})",
               walls);
}

constexpr int packets = 4, photons = 10000;

PhotonHarvest harvest_of(Scene const& scene, std::uint64_t seed) {
    RenderPlan const plan = make_plan(scene);
    PacketSet const set(make_wavelength_sampler(scene, plan), packets, seed);
    RayStatistics rays;
    return shoot_photons(scene, set, {seed, photons, longest_path, LightSurroundings(scene, plan)}, rays);
}

// Of lane 0, mean over the packets, as each packet stands for all the light [W/nm].
double power_of(PhotonList const& list) {
    double sum = 0;
    for (PhotonPower const& p : list.power) sum += static_cast<double>(p.flux[0]);
    return sum / packets;
}

}  // namespace

// What [Picardello 2022, ch. 11] gets wrong would show: pi twice at emission, a bounce without cos / p, and a roulette
// whose survivors are not divided by its probability.
TEST_CASE("number and power of photons in a closed room have their closed forms", "[law]") {
    for (double const rho : {0.3, 0.6, 0.9}) {
        auto const scene = test::scene_from(room(rho));
        PhotonHarvest const h = harvest_of(*scene, 5);
        double const emitted = pi_double, stored = rho / (1 - rho);
        double const per_photon = emitted / photons;
        // The number of scatterings of a photon is geometric: variance rho / (1 - rho)^2.
        double const n = packets * photons, error = std::sqrt(rho) / (1 - rho) / std::sqrt(n);
        CHECK(h.caustic.size() == 0);
        CHECK(static_cast<double>(h.indirect.size()) / n == Approx(stored).margin(5 * error));
        CHECK(power_of(h.indirect) == Approx(emitted * stored).margin(5 * error * emitted));
        CHECK((1 - rho) * (emitted + power_of(h.indirect)) == Approx(emitted).margin(5 * error * emitted));
        // One paint, grey: all photons are alike.
        for (PhotonPower const& p : h.indirect.power)
            REQUIRE(static_cast<double>(p.flux[0]) == Approx(per_photon).epsilon(1e-4));
    }
}

// A clear sphere of glass takes nothing and gives nothing, whichever way photons come, and no photon is in both maps.
TEST_CASE("glass in a closed room keeps the power of photons", "[law]") {
    constexpr double rho = 0.6;
    auto const scene = test::scene_from(room(
        rho,
        R"({ "type": "sphere", "centre": [0.2, 0.8, 0.1], "radius": 0.6, "material": { "type": "dielectric", "ior": 1.5 } },)"));
    PhotonHarvest const h = harvest_of(*scene, 6);
    double const emitted = pi_double, n = packets * photons, error = std::sqrt(rho) / (1 - rho) / std::sqrt(n);
    // What first arrives on the walls directly is not stored, what comes through the glass is.
    double const caustic = power_of(h.caustic), indirect = power_of(h.indirect);
    CHECK(caustic > 0.05 * emitted);
    CHECK(caustic < emitted);
    // Every photon arrives on a wall a first time, of which rho goes on.
    CHECK(indirect == Approx(emitted * rho / (1 - rho)).margin(5 * error * emitted));
}

// Photons are a function of their numbers.
TEST_CASE("photons are the same whenever they are emitted", "[law]") {
    auto const scene = test::scene_from(room(0.5));
    PhotonHarvest const a = harvest_of(*scene, 7), b = harvest_of(*scene, 7);
    REQUIRE(a.indirect.size() == b.indirect.size());
    bool same = true;
    for (std::size_t i = 0; i < a.indirect.size(); ++i)
        same = same && a.indirect.photon[i].position == b.indirect.photon[i].position &&
               a.indirect.power[i].flux[3] == b.indirect.power[i].flux[3];
    CHECK(same);
}
