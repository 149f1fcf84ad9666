// SPDX-License-Identifier: Apache-2.0
// Lamps whose radiance or intensity depends on direction: exitance, irradiance, power and samples say the same.
#include <fmt/format.h>

#include <catch2/catch.hpp>

#include "support/scenes.h"

using namespace iride;

namespace {

std::unique_ptr<Scene> lamp(std::string const& shape, std::string const& emission) {
    return test::scene_from(fmt::format(
        R"({{ "camera": {{ "eye": [0,0,-9], "target": [0,0,0], "field_deg": 30 }},
             "shapes": [ {{ "material": {{ "type": "black" }}, "emission": {{ {} }}, {} }} ] }})",
        emission, shape));
}
std::unique_ptr<Scene> spot(std::string const& keys) {
    return test::scene_from(
        R"({ "camera": { "eye": [0,0,-9], "target": [0,0,0], "field_deg": 30 }, "shapes": [], "lights": [
          { "type": "spot", "position": [0,0,0], "target": [0,0,1], "intensity": 3, )" +
        keys + " } ] }");
}

Wavelengths packet(Scene const& scene) {
    return WavelengthSampler(visible_range, visible_importance(), scene.grid).sample(0.3f);
}

double power(Scene const& scene) { return scene.lights.light(0).power(1); }

// The intensity that arrives from the spot at a place along d.
float intensity_along(Scene const& scene, Vector const& d) {
    auto const x = scene.lights.light(0).sample(d.normalized(), packet(scene), {.5f, .5f});
    return x ? x->radiance[0] : 0;
}

std::string const square_metre = R"("type": "quad", "corners": [[0,0,0],[1,0,0],[1,0,1],[0,0,1]])";

}  // namespace

// B = 2 pi L0 / (n + 2).
TEST_CASE("a lamp of radiance L0 cos^n has the exitance of the closed form", "[unit]") {
    constexpr std::array<double, 6> exitance{3.141592653589793,  2.0943951023931953, 1.5707963267948966,
                                             1.2566370614359172, 1.0471975511965976, 0.8975979010256552};
    for (std::size_t n = 0; n < exitance.size(); ++n)
        CHECK(power(*lamp(square_metre, fmt::format(R"("radiance": 1, "profile": {{ "exponent": {} }})", n))) ==
              Approx(exitance[n]).epsilon(1e-6));
    // Worked example: L = 6000 cos, B = 4000 pi.
    CHECK(power(*lamp(square_metre, R"("radiance": 6000, "profile": { "exponent": 1 })")) ==
          Approx(4000 * pi_double).epsilon(1e-6));
    CHECK(power(*lamp(square_metre, R"("radiance": 1, "two_sided": true, "profile": { "cone_deg": 30 })")) ==
          Approx(2 * pi_double * square(std::sin(radians(30)))).epsilon(1e-6));
}

// Of a coaxial disc that is seen up to the angle t: int L0 cos^n cos dw = 2 pi L0 (1 - cos^(n+2) t) / (n + 2), t at
// most the cone's.
TEST_CASE("the irradiance under a disc of radiance L0 cos^n is that of the closed form", "[law]") {
    for (double n : {0., 1., 4.})
        for (double cone : {90., 25.}) {
            auto const scene =
                lamp(R"("type": "disc", "centre": [0,1,0], "normal": [0,-1,0], "radius": 1)",
                     fmt::format(R"("radiance": 2, "profile": {{ "exponent": {}, "cone_deg": {} }})", n, cone));
            Wavelengths const w = packet(*scene);
            double sum = 0;
            constexpr std::uint32_t samples = 1 << 14;
            for (std::uint32_t i = 0; i < samples; ++i) {
                Sampler s(SamplerKind::sobol, 3, 0, i);
                auto const x = scene->lights.light(0).sample({0, 0, 0}, w, s.next2());
                if (x) sum += static_cast<double>(x->radiance[0] * x->wi.y() / x->density->value) / samples;
            }
            double const end = std::cos(radians(std::min(45.0, cone)));
            INFO("exponent " << n << ", cone " << cone);
            CHECK(sum == Approx(2 * 2 * pi_double * (1 - std::pow(end, n + 2)) / (n + 2)).epsilon(2e-3));
        }
}

// Every shape, both orders of front and back. Fails when the samples leave out the profile.
TEST_CASE("a sampled lamp brings what is emitted from the place found", "[law]") {
    std::vector<std::string> const shapes{
        R"("type": "sphere", "centre": [0.3,1.5,0.2], "radius": 0.9)",
        R"("type": "quad", "corners": [[-1,1,-1],[1,1,-1],[1,1,1.5],[-1,1,1.5]])",
        R"("type": "quad", "corners": [[-1,90,-1],[1,90,-1],[1,90,1.5],[-1,90,1.5]])",
        R"("type": "quad", "corners": [[-1,1,-1],[1.4,1,-0.8],[1,1,1.5],[-1.2,1,1]])",
        R"("type": "disc", "centre": [0.3,1.1,0.2], "normal": [0.2,-1,0.1], "radius": 0.9)",
        R"("type": "cylinder", "from": [-0.6,1.2,0.1], "to": [0.9,1.4,0.4], "radius": 0.5, "caps": false)",
        R"("type": "mesh", "vertices": [[-1,1,-1],[1.4,1.2,-0.8],[0.3,0.9,1.5]], "triangles": [[0,1,2]])"};
    for (std::string const& shape : shapes)
        for (char const* flip : {"false", "true"})
            for (char const* sides : {"false", "true"}) {
                auto const scene = lamp(
                    shape + ", \"flip\": " + flip,
                    fmt::format(R"("radiance": 2, "two_sided": {}, "profile": {{ "exponent": 2, "cone_deg": 40 }})",
                                sides));
                Wavelengths const w = packet(*scene);
                Light const& light = scene->lights.light(0);
                RayStatistics statistics;
                Vector const from(0.1f, 0, 0.2f);
                int found = 0, different = 0;
                for (std::uint32_t i = 0; i < 4000; ++i) {
                    Sampler s(SamplerKind::independent, 5, 0, i);
                    auto const x = light.sample(from, w, s.next2());
                    if (!x) continue;
                    auto const hit = scene->accelerator->closest({from, x->wi}, statistics);
                    if (!hit || std::abs(hit->distance - x->distance) > 1e-3f * x->distance) continue;
                    ++found;
                    float const emitted = light.emitted(hit->point, -x->wi, w)[0];
                    different += std::abs(emitted - x->radiance[0]) > 2e-3f * x->radiance[0];
                }
                INFO(shape << ", flip " << flip << ", two-sided " << sides << ": " << different << " of " << found);
                CHECK(different <= found / 200);  // at the edge of the cone
                if (sides == std::string("true")) CHECK(found > 100);
            }
}

// I0 cos^n to the cone's end, without a soft edge: int dw = 2 pi I0 (1 - cos^(n+1)) / (n + 1).
TEST_CASE("a spot of intensity I0 cos^n has the power of the closed form", "[unit]") {
    for (double n : {0., 1., 8.})
        for (double cone : {30., 60., 90.}) {
            auto const scene = spot(fmt::format(R"("cone_deg": {}, "full_deg": {}, "exponent": {})", cone, cone, n));
            double const end = std::pow(std::cos(radians(cone)), n + 1);
            CHECK(power(*scene) == Approx(3 * 2 * pi_double * (1 - end) / (n + 1)).epsilon(1e-4));
            for (double degrees : {0., 20., 29.}) {
                double const a = radians(degrees);
                CHECK(intensity_along(*scene, VectorDouble(std::sin(a), 0, std::cos(a)).cast<float>()) ==
                      Approx(3 * std::pow(std::cos(a), n)).epsilon(1e-5));
            }
        }
}

// A pyramid of half angles a and b: 4 asin(sin a sin b) sr. The beam goes along +z with y up, so its right is -x.
TEST_CASE("flaps cut a spot to the directions between them", "[unit]") {
    auto const pyramid = spot(R"("cone_deg": 89, "full_deg": 89, "flaps": { "x_deg": [-20, 20], "y_deg": [-35, 35] })");
    CHECK(power(*pyramid) == Approx(3 * 4 * std::asin(std::sin(radians(20)) * std::sin(radians(35)))).epsilon(5e-3));
    auto const crooked = spot(R"("cone_deg": 89, "full_deg": 89, "flaps": { "x_deg": [-10, 30], "y_deg": [-50, 5] })");
    auto const tangent = [](double degrees) { return static_cast<float>(std::tan(radians(degrees))); };
    for (auto const& [right, up, passes] : {std::tuple(29., 0., true),
                                            {31., 0., false},
                                            {-9., 0., true},
                                            {-11., 0., false},
                                            {0., 4., true},
                                            {0., 6., false},
                                            {0., -49., true},
                                            {0., -51., false}}) {
        INFO(right << " to the right, " << up << " up");
        CHECK(intensity_along(*crooked, Vector(-tangent(right), tangent(up), 1)) == (passes ? Approx(3) : Approx(0)));
    }
    CHECK(intensity_along(*crooked, Vector(0, 0, -1)) == 0);
    // Turned on its side: up is +x, right is -y ... x upwards, so the beam's right is +y.
    auto const turned = spot(R"("cone_deg": 89, "full_deg": 89, "up": [1,0,0], "flaps": { "x_deg": [0, 30] })");
    CHECK(intensity_along(*turned, Vector(0, .2f, 1)) == Approx(3));
    CHECK(intensity_along(*turned, Vector(0, -.2f, 1)) == 0);
}
