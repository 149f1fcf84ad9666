// SPDX-License-Identifier: Apache-2.0
// The white furnace through every integrator: a closed body that emits e and reflects rho everywhere, in which
//   L = e (1 + rho + ... + rho^n) = e (1 - rho^(n+1)) / (1 - rho)   with at most n scatterings, e / (1 - rho) without
//   end
// along every ray, whatever the body's shape. Mean and error are those of independent pictures. `ambient-occlusion`,
// which sees no light, is left out.
#include <fmt/format.h>

#include <catch2/catch.hpp>

#include "support/agreement.h"

using namespace iride;

namespace {

// A ball of glass that absorbs nothing changes nothing: light that it turns away is as bright as what it lets by. Out
// of sight, for those that show no mirror images.
std::string const glass =
    R"(, { "type": "sphere", "centre": [0.12,0.12,0.12], "radius": 0.1, "material": { "type": "dielectric", "ior": 1.5 } })";

// The cube, or the ball: without edges, at which a photon's disc reaches beyond the surface.
std::string furnace(double rho, bool ball, bool with_glass) {
    std::string const shape = ball ? R"("type": "sphere", "centre": [0.5,0.5,0.5], "radius": 0.5)"
                                   : R"("type": "box", "min": [0,0,0], "max": [1,1,1])";
    return fmt::format(
        R"({{ "camera": {{ "eye": [0.5,0.5,0.1], "target": [0.5,0.5,1], "field_deg": 90 }}, "film": {{ "size": [8, 8] }},
             "shapes": [ {{ {}, "flip": true, "material": {{ "type": "diffuse", "reflectance": {} }}, "emission": {{ "radiance": 1 }} }}{} ] }})",
        shape, rho, with_glass ? glass : "");
}

double series(double rho, int most) { return (1 - std::pow(rho, most + 1)) / (1 - rho); }
constexpr int endless = 1 << 20;

struct Method {
    char const* name;
    int most = endless;         // scatterings that it follows
    bool ball = false;          // in the ball; else in the cube
    bool takes_bounces = true;  // render.max_bounces ends its paths
    bool with_glass = false;
    double margin = 0.002, error = 0.0007;
};

test::Replicated pictures(Method const& m, Scene const& scene, int spp, std::uint64_t first_seed) {
    return test::replicated(16, [&](int i) {
        RenderSettings const settings{.spp = spp, .seed = first_seed + static_cast<std::uint64_t>(i)};
        Film const film = test::rendered(scene, m.name, settings);
        CHECK(film.rejected() == std::array<std::uint64_t, rejection_count>{});
        return test::picture_mean(film)[1].mean;
    });
}

void check_furnace(Method const& m, double rho, std::optional<int> bounces) {
    auto const scene = test::scene_from(furnace(rho, m.ball, m.with_glass));
    scene->render.max_bounces = bounces;
    double const expected = series(rho, std::min(m.most, bounces.value_or(endless)));
    // As many samples as a first try says are needed.
    constexpr int few = 16, most = 1 << 17;
    double const excess = pictures(m, *scene, few, 1000).error / expected / (0.7 * m.error);
    int const spp = static_cast<int>(std::clamp(few * excess * excess, 1.0, static_cast<double>(most)));
    test::Replicated const found = pictures(m, *scene, spp, 100);
    std::string const result =
        fmt::format("{}, rho {}, {} scatterings, {} spp: {:+.3f} % +- {:.3f} %", m.name, rho, bounces.value_or(-1), spp,
                    100 * (found.mean / expected - 1), 100 * found.error / expected);
    INFO(result);
    CHECK(std::abs(found.mean / expected - 1) < m.margin);
    CHECK(found.error / expected < m.error);
}

// Photons by a hundred thousand know the light of a wall to half a per cent only; a million are for the long test.
std::vector<Method> methods(bool many_photons) {
    std::vector<Method> all{{"path"},
                            {"reference_path"},
                            {"auto"},
                            {"light-tracing"},
                            {"bidirectional"},
                            {"bidirectional-power"},
                            {"bidirectional", endless, false, false, true},
                            {"caustic-path", endless, false, false, true},
                            {"direct", 1},
                            {"recursive", 1},
                            {"radiosity", endless, false, false},
                            {"directional-radiosity:patches=60", endless, false, false},
                            {"two-pass:patches=100"}};
    if (many_photons)
        all.insert(all.end(), {{"photon-map:photons=1000000", endless, true},
                               {"progressive-photon:photons=400000", endless, true},
                               {"final-gather:photons=1000000", endless, true}});
    else
        all.insert(all.end(), {{"photon-map:photons=100000", endless, true, true, false, 0.01, 0.003},
                               {"progressive-photon:photons=40000", endless, true, true, false, 0.01, 0.003},
                               {"final-gather:photons=100000", endless, true, true, false, 0.005, 0.0015}});
    return all;
}

}  // namespace

TEST_CASE("the furnaces' table has every integrator that sees light", "[unit]") {
    for (IntegratorEntry const& e : integrator_entries()) {
        std::string const name = e.name;
        bool found = name == "ambient-occlusion";
        for (Method const& m : methods(false))
            found = found || std::string(m.name).substr(0, std::string(m.name).find(':')) == name;
        INFO(name);
        CHECK(found);
    }
}

TEST_CASE("every integrator finds e / (1 - rho) in a furnace", "[.long]") {
    for (Method const& m : methods(false))
        for (double rho : {0.5, 0.8}) check_furnace(m, rho, {});
}

TEST_CASE("paths of n scatterings find the first n + 1 terms of a furnace's series", "[.long]") {
    for (Method const& m : methods(false))
        for (int bounces : {0, 1, 2, 5})
            if (m.takes_bounces) check_furnace(m, 0.7, bounces);
}

// Minutes.
TEST_CASE("every integrator finds e / (1 - rho) in a furnace of albedo .95", "[.long]") {
    for (Method const& m : methods(true)) check_furnace(m, 0.95, {});
}
