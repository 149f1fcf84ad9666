// SPDX-License-Identifier: Apache-2.0
// The laws every model with a density obeys, over one table of models (support/bsdf_models.h): sampling matches
// density, per lane and on both sides of the surface; weight is f cos / p; reciprocity; energy; no NaN whatever the
// arguments. "Fails for" names wrong models with which a test was seen to fail.
#include <catch2/catch.hpp>

#include "support/bsdf_models.h"
#include "support/lobe_histogram.h"

using namespace iride;

namespace {

std::vector<test::NamedModel> const& models() {
    static std::vector<test::NamedModel> const all = [] {
        std::vector<test::NamedModel> collected;
        for (auto const family : {test::diffuse_models, test::metal_models, test::glass_models, test::plastic_models,
                                  test::heuristic_models})
            std::ranges::move(family(), std::back_inserter(collected));
        return collected;
    }();
    return all;
}

Direction at_angle(double degrees, double azimuth = 0.4) {
    double const t = radians(degrees);
    return VectorDouble(std::sin(t) * std::cos(azimuth), std::sin(t) * std::sin(azimuth), std::cos(t)).cast<float>();
}
Direction other_side(Direction const& w) { return {w.x(), w.y(), -w.z()}; }

// A model seen from above at these angles, and from below if light passes through it.
template <class Check>
void from_both_sides(test::NamedModel const& m, std::initializer_list<double> angles, Check&& check) {
    for (double angle : angles)
        for (Direction const& wo : {at_angle(angle), other_side(at_angle(angle))}) {
            if (wo.z() < 0 && !m.with_hero) continue;
            INFO(m.name << " at " << angle << (wo.z() > 0 ? "" : " from below"));
            check(wo);
        }
}

Sample3 numbers(Sampler& s) { return {s.next(), s.next2()}; }

// n^2 of the side of w, for a lane.
double index_squared(test::NamedModel const& m, Direction const& w, int lane) {
    return w.z() > 0 ? 1 : square(static_cast<double>(m.index_below[lane]));
}

// Cells about the directions of mirror and refraction, the latter for a lane: facets turned by an angle turn it less.
test::LobeHistogram histogram_about_lobes(test::NamedModel const& m, Direction const& wo, int lane = 0) {
    using Lobe = test::LobeHistogram::Lobe;
    auto const width = static_cast<double>(m.width);
    Lobe const all_above{Direction(0, 0, std::copysign(1.0f, wo.z())), 2};
    Lobe const reflected = width < 2 ? Lobe{Direction(-wo.x(), -wo.y(), wo.z()), width} : all_above;
    float const n = m.index_below[lane], relative = wo.z() > 0 ? 1 / n : n;
    float const sine2 = square(relative) * (square(wo.x()) + square(wo.y()));
    // Beyond the critical angle: along the surface.
    Direction const through =
        Vector(-relative * wo.x(), -relative * wo.y(), std::copysign(std::sqrt(std::max(0.0f, 1 - sine2)), -wo.z()))
            .normalized();
    double const turned = std::abs(1 - static_cast<double>(relative));
    Lobe const refracted = m.with_hero && turned * width < .5 ? Lobe{through, turned * width}
                                                              : Lobe{Direction(0, 0, std::copysign(1.0f, -wo.z())), 2};
    return wo.z() > 0 ? test::LobeHistogram(reflected, refracted) : test::LobeHistogram(refracted, reflected);
}

}  // namespace

// Fails for a uniform instead of a cosine hemisphere in Lambert, for Beckmann's slope drawn without the factor of the
// projected area, and for a component of a mixture chosen by w_j alone.
TEST_CASE("sampled directions follow the stated density", "[law]") {
    constexpr int samples = 1000000;
    constexpr double level = 1e-3 / 200;  // Sidak over the cases
    for (test::NamedModel const& m : models()) {
        if (m.white && !m.with_hero) continue;  // their directions are those of the coloured twin
        from_both_sides(m, {20., 75.}, [&](Direction const& wo) {
            if (m.width < .05f && std::abs(wo.z()) < .5f) return;  // too thin across for the cells
            auto const density = [&](Direction const& wi) {
                return static_cast<double>(m.bsdf.evaluate(wo, wi).density[0]);
            };
            test::LobeHistogram histogram = histogram_about_lobes(m, wo);
            Sampler sampler(SamplerKind::independent, 7, 1, static_cast<std::uint32_t>(100 * (2 + wo.z())));
            for (int i = 0; i < samples; ++i) {
                if (auto const s = m.bsdf.sample(wo, numbers(sampler)); s && s->density)
                    histogram.add(s->wi);
                else
                    histogram.add_nothing();
            }
            CHECK(histogram.p_value(histogram.integrals(density, m.quadrature)) > level);
        });
    }
}

// Made the hero, a lane has the density that it had when it was not.
TEST_CASE("a lane's density is that of the same lane as the hero", "[law]") {
    for (test::NamedModel const& m : models()) {
        if (!m.with_hero) continue;
        std::vector<Bsdf> heroes;
        for (int lane = 0; lane < lane_count; ++lane) heroes.push_back(m.with_hero(lane));
        from_both_sides(m, {3., 40., 75.}, [&](Direction const& wo) {
            Sampler sampler(SamplerKind::independent, 3, 9, 0);
            for (int i = 0; i < 300; ++i) {
                auto const s = heroes[static_cast<std::size_t>(i % lane_count)].sample(wo, numbers(sampler));
                if (!s) continue;
                BsdfEvaluation const all = m.bsdf.evaluate(wo, s->wi);
                for (int lane = 0; lane < lane_count; ++lane) {
                    BsdfEvaluation const one = heroes[static_cast<std::size_t>(lane)].evaluate(wo, s->wi);
                    CHECK(all.density[lane] == Approx(one.density[0]).epsilon(1e-5));
                    CHECK(all.value[lane] == Approx(one.value[0]).epsilon(1e-5));
                }
                int const hero = i % lane_count;
                for (int lane = 0; lane < lane_count; ++lane) {
                    double const p = static_cast<double>(all.density[(lane + hero) % lane_count]);
                    CHECK(static_cast<double>(s->reach[lane]) ==
                          Approx(p / static_cast<double>(all.density[hero])).epsilon(1e-2).margin(1e-6));
                }
            }
        });
    }
}

// By quadrature: 1 for models that are white, whose density is f cos wi (n_i / n_o)^2, so that a white furnace stays
// white; elsewhere what is missing is the share of samples that fail.
TEST_CASE("densities integrate to one and white surfaces give back what they get", "[law]") {
    for (test::NamedModel const& m : models())
        from_both_sides(m, {0., 30., 60., 80.}, [&](Direction const& wo) {
            if (m.width < .05f && std::abs(wo.z()) < .5f) return;  // too thin across for the cells
            test::LobeHistogram const cells = histogram_about_lobes(m, wo);
            auto const total = [](std::vector<double> const& parts) {
                return std::accumulate(parts.begin(), parts.end(), 0.0);
            };
            double const all = total(cells.integrals(
                [&](Direction const& wi) { return static_cast<double>(m.bsdf.evaluate(wo, wi).density[0]); },
                m.quadrature));
            CHECK(all < 1.005);
            if (!m.white) return;
            CHECK(all > .995);
            for (int lane : {0, lane_count - 1}) {
                double const furnace = total(
                    histogram_about_lobes(m, wo, lane)
                        .integrals(
                            [&](Direction const& wi) {
                                return static_cast<double>(m.bsdf.evaluate(wo, wi).value[lane] * std::abs(wi.z())) *
                                       index_squared(m, wi, lane);
                            },
                            m.quadrature));
                CHECK(furnace == Approx(index_squared(m, wo, lane)).epsilon(5e-3));
            }
        });
}

// Fails for RoughConductor without the factor 1/4 in its density, and for Lambert's f without 1 / pi.
TEST_CASE("a sample's weight is f cos over its density", "[law]") {
    for (test::NamedModel const& m : models())
        from_both_sides(m, {0., 35., 70., 88., 89.9}, [&](Direction const& wo) {
            Sampler sampler(SamplerKind::independent, 3, 2, 0);
            // wi is rounded to 6e-8, the half vector of it and wo to that over |wo + wi|, the slope's share of alpha to
            // that over alpha; D is a steep function of the latter.
            auto const tolerance = [&](Direction const& wi) {
                double const half = std::abs(static_cast<double>(wo.z())) + std::abs(static_cast<double>(wi.z()));
                return 2e-3 + 6e-6 / (half * std::min(1.0, static_cast<double>(m.width)));
            };
            for (int i = 0; i < 500; ++i) {
                auto const s = m.bsdf.sample(wo, numbers(sampler));
                if (!s || !s->density) continue;
                if (tolerance(s->wi) > .1) continue;  // nothing is left to tell
                auto const e = m.bsdf.evaluate(wo, s->wi);
                CHECK(e.density[0] == Approx(s->density->value).epsilon(tolerance(s->wi)));
                for (int lane = 0; lane < lane_count; ++lane)
                    CHECK(static_cast<double>(s->weight[lane]) ==
                          Approx(static_cast<double>(e.value[lane] * std::abs(s->wi.z()) / e.density[0]))
                              .epsilon(tolerance(s->wi))
                              .margin(1e-6));
            }
        });
}

// f / n^2 of the side the light leaves on. Fails for G1(wo) instead of G2, for a reflectance by the cosine of wi
// against the surface, and for a refraction's half vector from wo + eta wi, which is rounded one way there and another
// way back.
TEST_CASE("light and viewer may change places", "[law]") {
    for (test::NamedModel const& m : models()) {
        if (!m.reciprocal) continue;
        from_both_sides(m, {0., 5., 40., 80., 89.9}, [&](Direction const& w1) {
            from_both_sides(m, {10., 55., 85., 89.}, [&](Direction const& w) {
                Direction const w2(-.8f * w.x() - .6f * w.y(), .6f * w.x() - .8f * w.y(), w.z());
                BsdfValue const there = m.bsdf.evaluate(w1, w2).value, back = m.bsdf.evaluate(w2, w1).value;
                for (int lane = 0; lane < lane_count; ++lane)
                    CHECK(static_cast<double>(there[lane]) / index_squared(m, w1, lane) ==
                          Approx(static_cast<double>(back[lane]) / index_squared(m, w2, lane))
                              .epsilon(1e-5)
                              .margin(1e-30));
            });
        });
    }
}

// Fails for F doubled.
TEST_CASE("no surface gives back more than it gets", "[law]") {
    for (test::NamedModel const& m : models()) {
        if (!m.conserving) continue;
        from_both_sides(m, {0., 30., 60., 85., 89.9}, [&](Direction const& wo) {
            Lanes albedo;
            constexpr std::uint32_t samples = 4096;
            for (std::uint32_t i = 0; i < samples; ++i) {
                Sampler s(SamplerKind::sobol, 5, 3, i);
                auto const x = m.bsdf.sample(wo, numbers(s));
                if (!x) continue;
                for (int lane = 0; lane < lane_count; ++lane) {
                    double const ratio = index_squared(m, x->wi, lane) / index_squared(m, wo, lane);
                    albedo.set(lane, albedo[lane] + x->weight[lane] * static_cast<float>(ratio / samples));
                }
            }
            // Lanes that go their own ways are weighed by p_lane / p_hero, whose mean is 1 only on average.
            CHECK((m.with_hero ? albedo[0] : largest(albedo).value) <= 1.0005f);
            CHECK(!is_negative(albedo));
        });
    }
}

namespace {

// Directions nobody expects: in the surface, a hair off it, along the normal, denormal, plain.
Direction hostile_direction(Sampler& s) {
    Direction const w = to_sphere(s.next2());
    Vector2 const around = Vector2(w.x(), w.y()).normalized();
    auto const near_surface = [&](float z) { return Direction(around.x(), around.y(), z); };
    switch (static_cast<int>(s.next() * 12)) {
        case 0:
            return near_surface(0);
        case 1:
            return near_surface(-0.0f);
        case 2:
            return near_surface(1e-7f);
        case 3:
            return near_surface(-3e-6f);
        case 4:
            return near_surface(1e-40f);
        case 5:
            return {0, 0, 1};
        case 6:
            return {0, 0, -1};
        case 7:
            return Vector(w.x(), w.y(), w.z() * 1e-3f).normalized();
        case 8:
            return Vector(w.x() * 1e-4f, w.y() * 1e-4f, w.z()).normalized();
        default:
            return w;
    }
}
float hostile_number(Sampler& s) {
    float const x = s.next();
    return x < .05f ? 0 : x > .95f ? one_minus_epsilon : s.next();
}

void call_with_hostile_arguments(std::uint32_t calls) {
    std::vector<test::NamedModel> const& all = models();
    std::uint32_t bad = 0;
    for (std::uint32_t i = 0; i < calls; ++i) {
        test::NamedModel const& m = all[i % all.size()];
        Sampler s(SamplerKind::independent, 17, 0, i);
        Direction const wo = hostile_direction(s), other = hostile_direction(s);
        float const pick = s.next();
        Direction const wi = pick < .1f   ? wo
                             : pick < .2f ? Direction(-wo)
                             : pick < .3f ? Direction(-wo.x(), -wo.y(), wo.z())
                                          : other;
        BsdfEvaluation const e = m.bsdf.evaluate(wo, wi);
        bool good = is_finite(e.value) && is_finite(e.density) && !is_negative(e.value) && !is_negative(e.density);
        if (auto const x = m.bsdf.sample(wo, {hostile_number(s), {hostile_number(s), hostile_number(s)}}))
            good &= is_finite(x->weight) && is_finite(x->reach) && !is_negative(x->weight) && !is_negative(x->reach) &&
                    std::abs(x->wi.norm() - 1) < 1e-5f && (!x->density || std::isfinite(x->density->value));
        if (good) continue;
        INFO(m.name << ", call " << i);
        if (++bad <= 10) CHECK(good);
    }
    CHECK(bad == 0);
}

}  // namespace

TEST_CASE("no model answers with NaN or less than nothing", "[law]") { call_with_hostile_arguments(1000000); }

TEST_CASE("no model answers with NaN or less than nothing, a hundred million times", "[.stress]") {
    call_with_hostile_arguments(100000000);
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
