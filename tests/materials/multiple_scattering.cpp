// SPDX-License-Identifier: Apache-2.0
// What light that meets several facets brings back. Each was seen to fail once: with the lobe m doubled (furnace), with
// mean_loss for loss(wi) in it (reciprocity), with the table's quadrature uniform in y (table), with F_avg instead of
// its square in F_ms (random walk).
#include <catch2/catch.hpp>

#include "base/sampler.h"
#include "support/conductors.h"
#include "support/dielectrics.h"

using namespace iride;

namespace {

constexpr std::array<float, 7> roughnesses{.05f, .1f, .2f, .3f, .5f, .7f, 1.0f};

Direction at_cosine(double cosine) {
    return {static_cast<float>(std::sqrt((1 - cosine) * (1 + cosine))), 0, static_cast<float>(cosine)};
}
Direction at_angle(double degrees) { return at_cosine(std::cos(radians(degrees))); }

// Directional albedo for F = 1 (to 1e-5) from evaluate() alone, blind to sample(): a grid of visible normals and one of
// cosine-weighted directions, joined by the balance heuristic.
double white_albedo(float alpha, Direction const& wo, int steps) {
    InterreflectingConductor const model = test::interreflecting(Lanes(1e-3f), Lanes(1000), alpha);
    Ggx const ggx{alpha};
    double sum = 0;
    for (int i = 0; i < steps; ++i)
        for (int j = 0; j < steps; ++j) {
            Sample2 const u{(static_cast<float>(i) + .5f) / static_cast<float>(steps),
                            (static_cast<float>(j) + .5f) / static_cast<float>(steps)};
            Direction const h = ggx.visible_normal(wo, u);
            for (Direction const& wi : {Direction(2 * wo.dot(h) * h - wo), to_cosine_hemisphere(u)}) {
                if (wi.z() <= 0) continue;
                Direction const half = (wo + wi).normalized();
                double const p = static_cast<double>(ggx.visible_density(wo, half).value / (4 * wo.dot(half)) +
                                                     cosine_hemisphere_density(wi.z()).value);
                sum += static_cast<double>(model.evaluate(wo, wi).value[0] * wi.z()) / p;
            }
        }
    return sum / (steps * steps);
}

// The loss by an independent route: random samples of visible normals, in the definition's own terms.
double loss_by_samples(float alpha, double cosine, std::uint32_t samples) {
    Ggx const ggx{alpha};
    Direction const wo = at_cosine(cosine);
    double sum = 0;
    for (std::uint32_t i = 0; i < samples; ++i) {
        Sampler s(SamplerKind::sobol, 11, 4, i);
        Direction const h = ggx.visible_normal(wo, s.next2());
        Direction const wi = 2 * wo.dot(h) * h - wo;
        if (wi.z() > 0) sum += static_cast<double>(ggx.masking_shadowing(wo, wi) / ggx.masking(wo));
    }
    return 1 - sum / samples;
}

Lanes albedo_by_samples(auto const& model, Direction const& wo, std::uint32_t samples) {
    Lanes albedo;
    for (std::uint32_t i = 0; i < samples; ++i) {
        Sampler s(SamplerKind::sobol, 5, 3, i);
        float const lobe = s.next();
        if (auto const x = model.sample(wo, {lobe, s.next2()}))
            albedo += x->weight * (1.0f / static_cast<float>(samples));
    }
    return albedo;
}

// Light followed from facet to facet over a Smith surface of uniform heights, all orders of bounces, F per lane.
// [Heitz 2016, alg. 1 to 3]
Lanes random_walk(Ggx ggx, Direction const& wo, Lanes n, Lanes k, Sampler& s) {
    auto const lambda = [&](Direction const& w) {
        return w.z() > 0 ? ggx.lambda(w) : -1 - ggx.lambda(Direction(w.x(), w.y(), -w.z()));
    };
    Lanes weight(1);
    Direction ray = -wo;
    float below = 1;  // share of the surface's heights below the ray
    for (int bounce = 0; bounce < 100; ++bounce) {
        float const u = s.next(), exponent = lambda(ray);
        if (ray.z() > 0 && u <= std::pow(below, exponent)) return weight;  // it escapes
        below = std::clamp(below / std::pow(1 - u, 1 / exponent), 1e-7f, 1.0f);
        Direction const h = ggx.visible_normal(-ray, s.next2());
        float const cosine = -ray.dot(h);
        weight *= fresnel_unpolarised(std::clamp(cosine, 0.0f, 1.0f), n, k);
        ray = (ray + 2 * cosine * h).normalized();
    }
    return Lanes(0);
}

}  // namespace

TEST_CASE("a white rough metal in a white furnace stays white", "[law]") {
    for (float alpha : roughnesses)
        for (double angle : {0., 30., 60., 80., 89.}) {
            double const albedo = white_albedo(alpha, at_angle(angle), 400);
            INFO("alpha " << alpha << " at " << angle << ": " << albedo);
            CHECK(std::abs(albedo - 1) < 5e-3);
        }
}

TEST_CASE("the table of lost light keeps its error bound", "[law]") {
    for (float alpha : {.001f, .01f, .05f, .2f, .5f, 1.0f})
        for (double cosine : {.0003, .002, .0123, .05, .111, .27, .456, .789, .95, 1.}) {
            INFO("alpha " << alpha << " cosine " << cosine);
            CHECK(std::abs(static_cast<double>(test::ggx_albedo(alpha).loss(static_cast<float>(cosine))) -
                           loss_by_samples(alpha, cosine, 1 << 17)) < 3e-4);
        }
}

TEST_CASE("the table has the published albedos of one scattering", "[unit]") {
    auto const albedo = [](float alpha, float cosine) { return 1 - test::ggx_albedo(alpha).loss(cosine); };
    CHECK(albedo(.5f, 1) == Approx(.6879).margin(1e-3).epsilon(0));
    CHECK(albedo(.5f, .5f) == Approx(.6983).margin(1e-3).epsilon(0));
    CHECK(albedo(1, 1) == Approx(.3069).margin(1e-3).epsilon(0));
    CHECK(albedo(1, .5f) == Approx(.4507).margin(1e-3).epsilon(0));
    CHECK(albedo(1, 1) == Approx(1 - std::log(2)).margin(3e-4).epsilon(0));
}

TEST_CASE("interreflection does not tell light from viewer", "[law]") {
    for (float alpha : roughnesses)
        for (double a : {0., 5., 40., 80., 89.})
            for (double b : {10., 55., 85., 89.9}) {
                auto const model = test::interreflecting(Lanes(.2f), Lanes(3), alpha);
                Direction const w1 = at_angle(a), w2 = at_angle(b);
                Direction const other(-.8f * w2.x(), .6f * w2.x(), w2.z());
                float const there = model.evaluate(w1, other).value[0], back = model.evaluate(other, w1).value[0];
                INFO("alpha " << alpha << " at " << a << ", " << b);
                CHECK(std::abs(there - back) < 1e-5f * there);
            }
}

// Gold, n + ik at 450 and 650 nm roughly: blue absorbed more at each bounce.
TEST_CASE("interreflection in rough gold saturates its colour", "[law]") {
    Lanes n(1.4f), k(1.9f);
    n.set(1, .16f), k.set(1, 3.4f);
    for (float alpha : {.2f, .5f, 1.0f})
        for (double angle : {0., 60.}) {
            Lanes const once = albedo_by_samples(RoughConductor{n, k, {alpha}}, at_angle(angle), 1 << 14);
            Lanes const often = albedo_by_samples(test::interreflecting(n, k, alpha), at_angle(angle), 1 << 14);
            CHECK(often[0] > once[0]);
            CHECK(often[1] > once[1]);
            CHECK(often[0] / often[1] < once[0] / once[1]);
        }
}

// The mean reflectance of a dielectric in closed form. [Walsh 1926]
TEST_CASE("the mean reflectance is that of the closed form", "[unit]") {
    for (double n : {1.2, 1.5, 2.0}) CHECK(mean_fresnel(n, 0) == Approx(test::walsh_mean_fresnel(n)).epsilon(1e-4));
}

TEST_CASE("interreflection comes near a random walk over the facets", "[law]") {
    Lanes n(1.4f), k(1.9f);
    n.set(1, .16f), k.set(1, 3.4f);
    for (float alpha : {.2f, .5f, 1.0f})
        for (double angle : {0., 30., 60., 80.}) {
            Direction const wo = at_angle(angle);
            constexpr std::uint32_t walks = 1 << 17;
            Lanes walked;
            for (std::uint32_t i = 0; i < walks; ++i) {
                Sampler s(SamplerKind::independent, 9, 2, i);
                walked += random_walk({alpha}, wo, n, k, s) * (1.0f / walks);
            }
            Lanes const model = albedo_by_samples(test::interreflecting(n, k, alpha), wo, 1 << 14);
            for (int lane : {0, 1}) {
                INFO("alpha " << alpha << " at " << angle << " lane " << lane << ": " << model[lane] << ", walk "
                              << walked[lane]);
                CHECK(std::abs(model[lane] - walked[lane]) < .025f);
            }
        }
}
