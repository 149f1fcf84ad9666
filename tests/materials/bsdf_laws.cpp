// SPDX-License-Identifier: Apache-2.0
// The laws every model with a density obeys, over one table of models (support/bsdf_models.h): sampling matches
// density, weight is f cos / p, reciprocity, energy. The comment above a test names the wrong models with which it was
// seen to fail.
#include <catch2/catch.hpp>

#include "support/bsdf_models.h"
#include "support/statistics.h"

using namespace iride;

namespace {

std::vector<test::NamedModel> const& models() {
    static std::vector<test::NamedModel> const all = [] {
        std::vector<test::NamedModel> collected;
        for (auto const family :
             {test::diffuse_models, test::metal_models, test::plastic_models, test::heuristic_models})
            std::ranges::move(family(), std::back_inserter(collected));
        return collected;
    }();
    return all;
}

Direction at_angle(double degrees, double azimuth = 0.4) {
    double const t = radians(degrees);
    return VectorDouble(std::sin(t) * std::cos(azimuth), std::sin(t) * std::sin(azimuth), std::cos(t)).cast<float>();
}

Sample3 numbers(Sampler& s) { return {s.next(), s.next2()}; }

}  // namespace

// Fails for a uniform instead of a cosine hemisphere in Lambert.
TEST_CASE("sampled directions follow the stated density", "[law]") {
    constexpr int samples = 1000000;
    constexpr double level = 1e-3 / 20;  // Sidak over the cases
    for (test::NamedModel const& m : models())
        for (double angle : {0., 35., 70., 86.}) {
            Direction const wo = at_angle(angle);
            test::DirectionHistogram histogram;
            Sampler sampler(SamplerKind::independent, 7, 1, static_cast<std::uint32_t>(angle));
            for (int i = 0; i < samples; ++i) {
                if (auto const s = m.bsdf.sample(wo, numbers(sampler)); s && s->density)
                    histogram.add(s->wi);
                else
                    histogram.add_nothing();
            }
            INFO(m.name << " at " << angle);
            auto const density = [&](Direction const& wi) {
                return static_cast<double>(m.bsdf.evaluate(wo, wi).density[0]);
            };
            CHECK(histogram.p_value(density, m.quadrature) > level);
            CHECK(histogram.integral_of(density, m.quadrature) < 1.002);
        }
}

// Fails for RoughConductor without the factor 1/4 in sample's density, or in both densities, and for Lambert's f
// without 1 / pi.
TEST_CASE("a sample's weight is f cos over its density", "[law]") {
    for (test::NamedModel const& m : models())
        for (double angle : {0., 35., 70., 88.}) {
            Direction const wo = at_angle(angle);
            Sampler sampler(SamplerKind::independent, 3, 2, static_cast<std::uint32_t>(angle));
            for (int i = 0; i < 1000; ++i) {
                auto const s = m.bsdf.sample(wo, numbers(sampler));
                if (!s || !s->density) continue;  // a Dirac lobe is not seen by evaluate()
                auto const e = m.bsdf.evaluate(wo, s->wi);
                INFO(m.name << " at " << angle);
                CHECK(e.density[0] == Approx(s->density->value).epsilon(2e-3));
                for (int lane = 0; lane < lane_count; ++lane)
                    CHECK(s->weight[lane] == Approx(e.value[lane] * s->wi.z() / e.density[0]).epsilon(2e-3));
            }
        }
}

// Fails for G1(wo) instead of G2, and for a reflectance by the cosine of wi against the surface, not the half vector.
TEST_CASE("light and viewer may change places", "[law]") {
    for (test::NamedModel const& m : models()) {
        if (!m.reciprocal) continue;
        for (double a : {5., 40., 80.})
            for (double b : {10., 55., 85.}) {
                Direction const w1 = at_angle(a), w2 = at_angle(b, 1.9);
                for (int lane = 0; lane < lane_count; ++lane)
                    CHECK(m.bsdf.evaluate(w1, w2).value[lane] ==
                          Approx(m.bsdf.evaluate(w2, w1).value[lane]).epsilon(1e-4));
            }
    }
}

// Fails for F doubled.
TEST_CASE("no surface gives back more than it gets", "[law]") {
    for (test::NamedModel const& m : models()) {
        if (!m.conserving) continue;
        for (double angle : {0., 30., 60., 85., 89.9}) {
            Direction const wo = at_angle(angle);
            Sampler sampler(SamplerKind::sobol, 5, 3, 0);
            Lanes albedo;
            constexpr int samples = 4096;
            for (std::uint32_t i = 0; i < samples; ++i) {
                Sampler s(SamplerKind::sobol, 5, 3, i);
                if (auto const x = m.bsdf.sample(wo, numbers(s))) albedo += x->weight * (1.0f / samples);
            }
            CHECK(largest(albedo).value <= 1.0001f);
            CHECK(!is_negative(albedo));
        }
    }
}

// Single-scattering GGX with F = 1: directional albedo by independent quadrature of D G2 / (4 cos), to four digits.
// Fails for G1(wo) instead of G2.
TEST_CASE("single scattering between GGX facets loses what theory says", "[law]") {
    auto const albedo = [](float alpha, double cosine) {
        Bsdf const mirror_facets = RoughConductor{Lanes(1e-3f), Lanes(1000.0f), {alpha}};
        Direction const wo(static_cast<float>(std::sqrt(1 - cosine * cosine)), 0, static_cast<float>(cosine));
        return test::replicated(16, [&](int repetition) {
            double sum = 0;
            constexpr std::uint32_t samples = 1 << 12;
            for (std::uint32_t i = 0; i < samples; ++i) {
                Sampler s(SamplerKind::sobol, 1, static_cast<std::uint32_t>(repetition), i);
                if (auto const x = mirror_facets.sample(wo, numbers(s))) sum += static_cast<double>(x->weight[0]);
            }
            return sum / samples;
        });
    };
    auto const check = [&](float alpha, double cosine, double exact) {
        auto const found = albedo(alpha, cosine);
        INFO("alpha " << alpha << ", cosine " << cosine << ": " << found.mean << " +- " << found.error);
        constexpr double level = 4.8;  // t of 15 degrees of freedom at 1e-3 / 4, two-sided
        CHECK(std::abs(found.mean - exact) < level * found.error + 5e-5);
        CHECK(found.error < 3e-4);
    };
    check(.5f, 1, .6879);
    check(.5f, .5, .6983);
    check(1, 1, .3069);
    check(1, .5, .4507);
}

// Fails when the transmitted radiance is not scaled by the squared index ratio, and for Snell's law or the Fresnel
// equations with the index ratio turned over.
TEST_CASE("a glass surface in a furnace of L / n^2 disappears", "[law]") {
    Bsdf const glass = SmoothDielectric{Lanes(1.5f), Lanes(1)};
    for (double angle : {0., 20., 40., 60., 80.})
        for (bool outside : {true, false}) {
            Direction wo = at_angle(angle);
            if (!outside) wo.z() = -wo.z();
            double sum = 0;
            constexpr std::uint32_t samples = 1 << 14;
            for (std::uint32_t i = 0; i < samples; ++i) {
                Sampler s(SamplerKind::sobol, 2, 5, i);
                auto const x = glass.sample(wo, numbers(s));
                REQUIRE(x);
                double const n2 = x->wi.z() > 0 ? 1 : 2.25;  // radiance there: n^2
                sum += static_cast<double>(x->weight[0]) * n2;
            }
            CHECK(sum / samples == Approx(outside ? 1 : 2.25).epsilon(1e-5));  // every sample brings this much
        }
}

// ((n - 1) / (n + 1))^2 at normal incidence. Fails when the other lanes get the hero's share of the reflection.
TEST_CASE("a glass reflection keeps every lane, each with its own reflectance", "[law]") {
    Lanes n(1.5f);
    n.set(lane_count - 1, 1.6f);
    Bsdf const glass = SmoothDielectric{n, Lanes(1)};
    auto const s = glass.sample(Direction(0, 0, 1), {0, {.5f, .5f}});
    REQUIRE(s);
    CHECK(s->wi == Direction(0, 0, 1));
    double const ratio = square(0.6 / 2.6) / square(0.5 / 2.5);
    CHECK(s->weight[0] == Approx(1).epsilon(1e-6));
    CHECK(s->reach[0] == Approx(1).epsilon(1e-6));
    CHECK(s->weight[lane_count - 1] == Approx(ratio).epsilon(1e-5));
    CHECK(s->reach[lane_count - 1] == Approx(ratio).epsilon(1e-5));
}

// Fails for sin(theta_i) = eta sin(theta_o), and for reach 1 in all lanes.
TEST_CASE("refraction obeys Snell's law and only equal indices go together", "[law]") {
    Lanes n(1.5f);
    n.set(lane_count - 1, 1.6f);
    Bsdf const glass = SmoothDielectric{n, Lanes(1)};
    Direction const wo = at_angle(30, 0);
    auto const s = glass.sample(wo, {0.99f, {.5f, .5f}});
    REQUIRE(s);
    CHECK(s->wi.x() == Approx(-1.0 / 3).epsilon(1e-6));
    CHECK(s->wi.z() == Approx(-.942809042).epsilon(1e-6));
    CHECK(!s->density);
    CHECK(s->reach[0] == 1);
    CHECK(s->reach[lane_count - 1] == 0);
    CHECK(s->weight[lane_count - 1] == 0);
}
