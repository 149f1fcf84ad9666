// SPDX-License-Identifier: Apache-2.0
// Rays that leave lights follow their stated densities, and the mean of their flux is the light's power.
#include <catch2/catch.hpp>

#include "support/scenes.h"
#include "support/statistics.h"

using namespace iride;

namespace {

constexpr double level = 1e-5;  // of each chi-squared test

Ball const ball{Vector(0.3f, -0.2f, 0.5f), 2.5f};

Wavelengths some_wavelengths(WavelengthGrid const& grid = WavelengthGrid::covering(visible_range)) {
    return WavelengthSampler(visible_range, visible_importance(), grid).sample(0.3f);
}

std::optional<EmissionSample> emitted(Light const& light, Wavelengths const& w, std::uint32_t i,
                                      SamplerKind kind = SamplerKind::independent) {
    Sampler s(kind, 31, 0, i);
    Sample2 const place = s.next2();
    return light.emit(ball, w, place, s.next2());
}

// `density`: of directions [1/sr].
void check_directions(Light const& light, Wavelengths const& w,
                      std::function<double(Direction const&)> const& density) {
    test::DirectionHistogram histogram;
    for (std::uint32_t i = 0; i < 200000; ++i) {
        auto const e = emitted(light, w, i);
        if (!e) {
            histogram.add_nothing();
            continue;
        }
        histogram.add(e->travel);
        if (i % 64 != 0) continue;
        CHECK(e->travel.norm() == Approx(1).epsilon(1e-5));
        CHECK(e->density.direction.value == Approx(density(e->travel)).epsilon(1e-3).margin(1e-6));
        CHECK(e->density.product() ==
              Approx(light.emission_density(ball, e->travel, e->cosine).product()).epsilon(1e-3));
    }
    CHECK(histogram.p_value(density) > level);
}

double mean_flux(Light const& light, Wavelengths const& w) {
    double sum = 0;
    constexpr std::uint32_t samples = 1 << 16;
    for (std::uint32_t i = 0; i < samples; ++i)
        if (auto const e = emitted(light, w, i, SamplerKind::sobol)) sum += static_cast<double>(e->flux()[0]);
    return sum / samples;
}

std::unique_ptr<Scene> lamp(std::string const& shape, std::string const& emission) {
    return test::scene_from(
        R"({ "camera": { "eye": [0,0,-9], "target": [0,0,0], "field_deg": 30 }, "shapes": [ { "material": { "type": "black" }, "emission": {)" +
        emission + "}, " + shape + " } ] }");
}

}  // namespace

TEST_CASE("lamps of any shape send out their power, from places and by densities that scattering would find", "[law]") {
    for (
        char const* shape :
        {R"("type": "quad", "corners": [[-1,1,-1],[1,1,-1],[1,1,1.5],[-1,1,1.5]])",
         R"("type": "quad", "corners": [[-1,1,-1],[1.4,1,-0.8],[1,1,1.5],[-1.2,1,1]])",
         R"("type": "sphere", "centre": [0.3,1.5,0.2], "radius": 0.9)",
         R"("type": "disc", "centre": [0.3,1.1,0.2], "normal": [0.2,-1,0.1], "radius": 0.9)",
         R"("type": "cone", "from": [0.2,-0.4,0.1], "to": [0.3,1.6,0.4], "radius": 0.6, "top_radius": 1.1, "caps": false)",
         R"("type": "mesh", "vertices": [[-1,1,-1],[1.4,1.2,-0.8],[0.3,0.9,1.5],[0.2,2.4,0.1]], "triangles": [[0,1,2],[0,1,3],[1,2,3],[2,0,3]])"})
        for (char const* emission :
             {R"("radiance": 1)", R"("radiance": 1, "two_sided": true)",
              R"("radiance": 1, "two_sided": true, "profile": { "exponent": 3, "cone_deg": 50 })"}) {
            INFO(shape << emission);
            auto const scene = lamp(shape, emission);
            Wavelengths const w = some_wavelengths(scene->grid);
            Light const& light = scene->lights.light(0);
            CHECK(mean_flux(light, w) == Approx(light.power(ball.radius)).epsilon(2e-3));
            RayStatistics statistics;
            int missed = 0, compared = 0;
            for (std::uint32_t i = 0; i < 1000; ++i) {
                auto const e = emitted(light, w, i);
                if (!e) continue;
                ++compared;
                // Looked back at along the ray the place is there, and as bright.
                constexpr float before = 0.01f;
                Vector const from = e->from.position + before * e->travel;
                auto const hit = scene->accelerator->closest({from, -e->travel}, statistics);
                bool const other_triangle = std::holds_alternative<MeshShape>(scene->shapes[0].geometry) && hit &&
                                            hit->primitive != e->primitive;  // beyond an edge
                if (!hit || other_triangle || std::abs(hit->distance - before) > 1e-3f) {
                    ++missed;
                    continue;
                }
                CHECK(light.emitted(hit->point, e->travel, w)[0] == Approx(e->radiance[0]).epsilon(1e-3));
                float const cosine = e->travel.dot(hit->point.geometric_normal);
                CHECK(std::abs(cosine) == Approx(e->cosine).epsilon(2e-3).margin(1e-3));
                CHECK(light.emission_density(ball, e->travel, cosine).product() ==
                      Approx(e->density.product()).epsilon(5e-3).margin(1e-4));
                CHECK(light.density(from, e->from, e->primitive).value > 0);
            }
            CHECK(compared > 900);
            CHECK(missed <= compared / 50);  // edges, and grazing rays of the curved ones
        }
}

// cos / pi and (e + 2) cos^(e+1) / (2 pi (1 - end^(e+2))) about the normal.
TEST_CASE("a lamp's rays follow its profile", "[law]") {
    Direction const n = Vector(0.2f, -1, 0.1f).normalized();
    std::string const disc = R"("type": "disc", "centre": [0.3,1.1,0.2], "normal": [0.2,-1,0.1], "radius": 0.9)";
    auto const plain = lamp(disc, R"("radiance": 1)");
    check_directions(plain->lights.light(0), some_wavelengths(plain->grid),
                     [&](Direction const& d) { return std::max(0.0, static_cast<double>(d.dot(n)) / pi_double); });
    auto const both = lamp(disc, R"("radiance": 1, "two_sided": true, "profile": { "exponent": 3, "cone_deg": 50 })");
    double const end = std::cos(radians(50.));
    check_directions(both->lights.light(0), some_wavelengths(both->grid), [&](Direction const& d) {
        double const c = std::abs(static_cast<double>(d.dot(n)));
        return c > end ? 5 * std::pow(c, 4) / (4 * pi_double * (1 - std::pow(end, 5))) : 0.0;
    });
}

TEST_CASE("a spot with barn doors sends out its power within its cone", "[law]") {
    Direction const axis = Vector(0.2f, -1, 0.3f).normalized();
    float const cos_full = static_cast<float>(std::cos(radians(10.))),
                cos_end = static_cast<float>(std::cos(radians(40.)));
    Frame const frame = Frame::around(axis);
    SpotFlaps const flaps{frame.tangent, frame.bitangent, {-0.3f, -9}, {0.2f, 9}};
    Wavelengths const w = some_wavelengths();
    auto const light =
        make_spot_light({1, 2, 3}, {axis, cos_full, cos_end, 2, flaps}, Spectrum<dim::spectral_intensity>(3.0f), 3);
    CHECK(mean_flux(*light, w) == Approx(light->power(1)).epsilon(5e-3));
    auto const open = make_spot_light({1, 2, 3}, {axis, cos_full, cos_end}, Spectrum<dim::spectral_intensity>(3.0f), 3);
    check_directions(*open, w, [&](Direction const& d) {
        return d.dot(axis) > cos_end ? 1 / (2 * pi_double * (1 - static_cast<double>(cos_end))) : 0.0;
    });
    auto const point = make_point_light({1, 2, 3}, Spectrum<dim::spectral_intensity>(3.0f), 3);
    CHECK(mean_flux(*point, w) == Approx(3 * 4 * pi_double).epsilon(1e-4));
    CHECK(point->power(1) == Approx(3 * 4 * pi_double).epsilon(1e-4));
}

// Every ray crosses the ball, evenly over its disc: the mean squared distance from the centre is half the radius'.
TEST_CASE("light from infinity passes evenly through the disc of the scene", "[law]") {
    auto const distant = make_distant_light(Vector(1, -2, 2) / 3, Spectrum<dim::spectral_irradiance>(0.75f), 0.75);
    auto const sky = make_constant_environment(Emission(2.5f), 2.5);
    Wavelengths const w = some_wavelengths();
    for (Light const* light : {distant.get(), sky.get()}) {
        CHECK(mean_flux(*light, w) == Approx(light->power(ball.radius)).epsilon(1e-3));
        double squares = 0, largest = 0;
        constexpr std::uint32_t samples = 4096;
        for (std::uint32_t i = 0; i < samples; ++i) {
            auto const e = emitted(*light, w, i, SamplerKind::sobol);
            REQUIRE(e);
            Vector const d = e->from.position - ball.centre;
            CHECK(d.dot(e->travel) == Approx(-ball.radius).epsilon(1e-3));
            double const r = d.cross(e->travel).norm();
            squares += r * r / samples;
            largest = std::max(largest, r);
        }
        CHECK(largest <= static_cast<double>(ball.radius) * (1 + 1e-5));
        CHECK(squares == Approx(square(static_cast<double>(ball.radius)) / 2).epsilon(5e-3));
    }
    check_directions(*sky, w, [](Direction const&) { return 1 / (4 * pi_double); });
}
