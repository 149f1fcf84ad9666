// SPDX-License-Identifier: Apache-2.0
// Coatings on glass and films by themselves, as the sampling loop sees them: closed forms, both sides, nothing lost.
#include <catch2/catch.hpp>

#include "base/constants.h"
#include "materials/coated_dielectric_material.h"
#include "support/bsdf_models.h"
#include "support/scenes.h"

using namespace iride;

namespace {

ComplexIndex constant(double n, double k = 0) { return {SpectralFunction::constant(n), SpectralFunction::constant(k)}; }

WavelengthGrid const grid = WavelengthGrid::covering(visible_range);

Wavelengths packet(float u = .3f) {
    return WavelengthSampler(visible_range, SpectralFunction::constant(1), grid).sample(u);
}

Direction at_cosine(float c) { return {std::sqrt(1 - c * c), 0, c}; }

// The packet with lane `first` as the hero.
Wavelengths rotated(Wavelengths const& w, int first) {
    Wavelengths r = w;
    for (int i = 0; i < lane_count; ++i) {
        int const from = (i + first) % lane_count;
        r.nm[i] = w.nm[from];
        r.cell[i] = w.cell[from];
        r.fraction[i] = w.fraction[from];
    }
    return r;
}

// Each lane's reflected and transmitted power, the latter with the radiance's scale taken away: mean over the random
// number that chooses the lobe and over the heroes, by the mixture of lanes that an integrator uses, since a hero that
// its film does not reflect finds no reflection of the others.
struct Shares {
    Lanes R, T;
};
Shares shares(Material const& material, Direction const& wo, float relative) {
    constexpr int steps = 4096;
    Shares sum;
    for (int hero = 0; hero < lane_count; ++hero) {
        Bsdf const bsdf = material.at({}, rotated(packet(), hero));
        for (int i = 0; i < steps; ++i) {
            auto const s = bsdf.sample(wo, {(static_cast<float>(i) + .5f) / steps, {.5f, .5f}});
            if (!s) continue;
            bool const same_side = s->wi.z() * wo.z() > 0;
            float const scale = (same_side ? 1 : relative * relative) / (mean(s->reach).value * steps * lane_count);
            Lanes& part = same_side ? sum.R : sum.T;
            for (int lane = 0; lane < lane_count; ++lane) {
                int const own = (lane + hero) % lane_count;
                part.set(own, part[own] + s->weight[lane] * scale);
            }
        }
    }
    return sum;
}

}  // namespace

// ((n0 ns - n1^2) / (n0 ns + n1^2))^2 at the design wavelength; half a wave thick, the film is absent. Fails with the
// phase of one crossing instead of two.
TEST_CASE("a quarter wave of 1.38 on glass is an antireflection coating in the sampling loop", "[law]") {
    double const n1 = 1.38, ns = 1.5168;
    Wavelengths w = packet();
    for (int lane = 0; lane < lane_count; ++lane) {
        double const nm = static_cast<double>(w.nm[lane]);
        for (double waves : {.25, .5}) {
            std::vector<CoatingLayer> const film{{constant(n1), waves * nm / n1}};
            CoatingTable const table(film, constant(ns), grid);
            double const closed = waves == .5 ? square((1 - ns) / (1 + ns)) : square((ns - n1 * n1) / (ns + n1 * n1));
            for (bool inside : {false, true}) {
                auto const [R, T] = table.power(table.row_of(w), 1, inside);
                CHECK(R[lane] == Approx(closed).margin(1e-6).epsilon(0));
                CHECK(T[lane] == Approx(1 - closed).margin(1e-6).epsilon(0));
            }
        }
    }
}

// Fails with the layers in the same order from both sides, and with the sine of one side taken for the other's.
TEST_CASE("the lanes' stack is wave optics' from both sides of a glass", "[law]") {
    std::vector<CoatingLayer> const layers{{constant(1.38), 100}, {constant(2.3, .02), 60}, {constant(1.6), 2000}};
    ComplexIndex const glass = constant(1.52), air{};
    CoatingTable const table(layers, glass, grid);
    PlaneStack const outside{air, layers, glass}, inside = outside.seen_from_inside();
    Wavelengths const w = packet(.7f);
    for (float c : {1.f, .8f, .5f, .2f, .03f, 1e-4f})
        for (bool from_inside : {false, true}) {
            auto const [R, T] = table.power(table.row_of(w), c, from_inside);
            for (int lane = 0; lane < lane_count; ++lane) {
                auto const exact =
                    (from_inside ? inside : outside).power(static_cast<double>(w.nm[lane]), static_cast<double>(c));
                CHECK(R[lane] == Approx(exact.R.unpolarised()).margin(coating_tolerance).epsilon(0));
                CHECK(T[lane] == Approx(exact.T.unpolarised()).margin(coating_tolerance).epsilon(0));
                CHECK(R[lane] + T[lane] <= 1);
            }
        }
}

// Every lane: what is not reflected is transmitted, whichever lane is the hero. Seen to fail with the sine of one side
// taken for the other's.
TEST_CASE("a lossless coating loses no light of any lane", "[law]") {
    std::vector<CoatingLayer> const layers{{constant(1.38), 100}, {constant(2.3), 260}};
    CoatedDielectricMaterial const glass(CoatingTable(layers, constant(1.5), grid), grid);
    FilmMaterial const soap(CoatingTable(std::vector<CoatingLayer>{{constant(1.33), 400}}, {}, grid));
    for (Material const* m : std::initializer_list<Material const*>{&glass, &soap})
        for (float c : {1.f, .7f, .3f, -.9f, -.8f, -.3f}) {
            float const n = m == &soap ? 1 : 1.5f, relative = c > 0 ? n : 1 / n;
            auto const s = shares(*m, at_cosine(c), relative);
            for (int lane = 0; lane < lane_count; ++lane) {
                INFO("cosine " << c << ", lane " << lane);
                CHECK(s.R[lane] + s.T[lane] == Approx(1).margin(3e-3));
                if (n > 1 && c == -.3f) CHECK(s.R[lane] == Approx(1).margin(1e-5));  // beyond the critical angle
            }
        }
}

// Snell's law holds as for the bare boundary; a film lets light go straight on, in every lane, with p_lane / p_hero.
TEST_CASE("light refracts under a coating as without, and goes straight through a film", "[law]") {
    std::vector<CoatingLayer> const layers{{constant(1.38), 100}};
    CoatedDielectricMaterial const glass(CoatingTable(layers, constant(1.5), grid), grid);
    FilmMaterial const film(CoatingTable(layers, {}, grid));
    Direction const wo = at_cosine(static_cast<float>(std::cos(radians(30))));
    auto const refracted = glass.at({}, packet()).sample(wo, {.9999f, {.5f, .5f}});
    REQUIRE(refracted);
    CHECK(refracted->wi.x() == Approx(-1.0 / 3).epsilon(1e-6));
    CHECK(refracted->wi.z() == Approx(-.942809042).epsilon(1e-6));
    auto const straight = film.at({}, packet()).sample(wo, {.9999f, {.5f, .5f}});
    REQUIRE(straight);
    CHECK((straight->wi + wo).norm() < 1e-6f);
    auto const [R, T] = film.plane()->layers.empty() ? LanePower{} : [&] {
        CoatingTable const table(layers, {}, grid);
        return table.power(table.row_of(packet()), wo.z());
    }();
    for (int lane = 0; lane < lane_count; ++lane) {
        CHECK(straight->reach[lane] == Approx(T[lane] / T[0]).epsilon(1e-4));
        CHECK(straight->weight[lane] == Approx(T[lane] / T[0]).epsilon(1e-4));
        CHECK(straight->reach[lane] > 0);
    }
    CHECK(!film.traits.dispersive);
}

// Airy's formula: R = 4 r^2 sin^2 b / ((1 - r^2)^2 + 4 r^2 sin^2 b), r of one face, b = 2 pi n d cos / lambda; at
// vanishing thickness a soap film is black. Seen to fail with half the phase.
TEST_CASE("a soap film reflects Airy's sum, and nothing when it is thinnest", "[law]") {
    double const n = 1.33;
    Wavelengths const w = packet(.5f);
    for (double thickness : {0., 5., 120., 700., 4000.}) {
        CoatingTable const table(std::vector<CoatingLayer>{{constant(n), thickness}}, {}, grid);
        for (double c : {1., .6, .1}) {
            double const below = std::sqrt(1 - (1 - c * c) / (n * n));
            Lanes const R = table.reflectance(table.row_of(w), static_cast<float>(c));
            for (int lane = 0; lane < lane_count; ++lane) {
                double const phase = 2 * pi_double * n * thickness * below / static_cast<double>(w.nm[lane]);
                auto const airy = [&](double r) {
                    double const x = 4 * r * r * square(std::sin(phase));
                    return x / (square(1 - r * r) + x);
                };
                double const rs = (c - n * below) / (c + n * below), rp = (n * c - below) / (n * c + below);
                CHECK(R[lane] == Approx((airy(rs) + airy(rp)) / 2).margin(1e-4).epsilon(0));
            }
        }
    }
}

TEST_CASE("coated glass and films are read from scene files", "[unit]") {
    auto const scene = test::scene_from(
        R"({ "camera": { "eye": [0,0,-5], "target": [0,0,0], "field_deg": 40 }, "materials": {
             "lens": { "type": "dielectric", "ior": "N-BK7", "coating": [ { "ior": 1.38, "thickness_nm": 99.6 } ] },
             "soap": { "type": "film", "layers": [ { "ior": 1.33, "thickness_nm": 400 } ] } } })");
    for (NamedMaterial const& m : scene->materials) {
        CHECK(!m.material->traits.two_sided);
        CHECK(!m.material->traits.has_density);
        CHECK(m.material->traits.dispersive == (m.name == "lens"));
        REQUIRE(m.material->plane());
        CHECK(m.material->plane()->layers.size() == 1);
    }
}

TEST_CASE("coatings that are none are refused with their place", "[input]") {
    auto const refused = [](std::string const& material, std::string const& says) {
        INFO(material);
        CHECK_THROWS_WITH(
            test::scene_from(
                R"({ "camera": { "eye": [0,0,-5], "target": [0,0,0], "field_deg": 40 }, "materials": { "m": )" +
                material + " } }"),
            Catch::Matchers::Contains(says));
    };
    refused(R"({ "type": "film" })", "layers");
    refused(R"({ "type": "film", "layers": [] })", "1 .. 32 layers");
    refused(R"({ "type": "film", "layers": [ { "ior": 1.33, "thickness_nm": -1 } ] })", "thickness_nm");
    refused(R"({ "type": "film", "layers": [ { "ior": 1.33, "thickness_nm": 1e6 } ] })", "not coherent");
    refused(R"({ "type": "film", "layers": [ { "ior": 1.33, "thickness_nm": 10 } ], "exterior_ior": "Au" })",
            "absorbs");
    refused(R"({ "type": "dielectric", "ior": 1.5, "coating": [ { "ior": 1.38, "thicknes_nm": 99 } ] })",
            "did you mean 'thickness_nm'");
}
