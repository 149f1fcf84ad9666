// SPDX-License-Identifier: Apache-2.0
// A coat over a diffuse base: the light trapped between them, to all orders.
#include <catch2/catch.hpp>

#include "support/dielectrics.h"
#include "support/quadrature.h"

using namespace iride;

namespace {

// Albedo of the diffuse lobe by quadrature, and of the mirror image by Fresnel's equations.
double smooth_albedo(SmoothPlastic const& model, double angle, int lane) {
    double const n = static_cast<double>(model.coat.n[lane]);
    return static_cast<double>(test::albedo(model, test::at_angle(angle))[lane]) +
           fresnel(std::cos(radians(angle)), n, 0.0).unpolarised();
}

// Light that has entered: flights between a Lambertian base and a smooth coat, until it leaves or is absorbed. The
// share of what enters at `angle` that leaves.
double random_walk(double n, double rho, double depth, double angle, int walks) {
    double sum = 0;
    for (int i = 0; i < walks; ++i) {
        Sampler s(SamplerKind::independent, 4, 1, static_cast<std::uint32_t>(i));
        double weight = std::exp(-depth / std::sqrt(1 - square(std::sin(radians(angle)) / n)));
        for (int bounce = 0; bounce < 200; ++bounce) {
            weight *= rho;
            double const mu = std::sqrt(static_cast<double>(1 - s.next()));
            double const F = fresnel(mu, 1 / n, 0.0).unpolarised(), passage = std::exp(-depth / mu);
            sum += weight * passage * (1 - F);
            weight *= passage * F * passage;
        }
    }
    return sum / walks;
}

}  // namespace

// Duntley's relation with the mean of Fresnel's equations in closed form, and the number of [Saunderson 1942] for n =
// 1.5: .596. Fails for R_i = mean F, and when the coat's absorption is left out.
TEST_CASE("a clear coat sends back to its base what the closed form says", "[unit]") {
    for (double n : {1.2, 1.5, 2.0}) {
        double const closed = 1 - (1 - test::walsh_mean_fresnel(n)) / square(n);
        CHECK(internal_reflectance(n, mean_fresnel(n, 0), 0) == Approx(closed).epsilon(1e-5));
        CHECK(internal_reflectance(n, mean_fresnel(n, 0), 1e-7) == Approx(closed).epsilon(1e-4));
    }
    CHECK(internal_reflectance(1.5, mean_fresnel(1.5, 0), 0) == Approx(.596).margin(5e-4));
    CHECK(internal_reflectance(1, 0, 0) == 0);
    CHECK(internal_reflectance(1, 0, 1) == 0);
    CHECK(internal_reflectance(1.5, mean_fresnel(1.5, 0), 50) == Approx(0).margin(1e-6));
}

// F + (1 - F)(1 - R_i) rho / (1 - rho R_i), R_i in closed form. Fails for rho / (1 - rho R_i) without 1 / n^2, and for
// R_i = mean F.
TEST_CASE("the albedo of a clear smooth coat over any base is Saunderson's", "[law]") {
    Lanes const n = test::coat_indices();
    for (double rho : {.18, .6, 1.0}) {
        SmoothPlastic const model = test::smooth_plastic(n, Lanes(static_cast<float>(rho)));
        for (double angle : {0., 40., 70., 85., 89.})
            for (int lane : {0, 4, 7}) {
                double const index = static_cast<double>(n[lane]);
                double const F = fresnel(std::cos(radians(angle)), index, 0.0).unpolarised();
                double const inside = 1 - (1 - test::walsh_mean_fresnel(index)) / square(index);
                double const expected = F + (1 - F) * (1 - inside) * rho / (1 - rho * inside);
                INFO("rho " << rho << " at " << angle << ", n " << index);
                CHECK(smooth_albedo(model, angle, lane) == Approx(expected).margin(3e-4));
                if (rho == 1) CHECK(expected == Approx(1).epsilon(1e-12));
            }
    }
}

// Fails when the coat's absorption is left out of the round trips.
TEST_CASE("an absorbing coat lets out what a random walk inside it does", "[law]") {
    Lanes const n(1.5f);
    for (double depth : {.05, .5, 2.0})
        for (double rho : {.5, 1.0}) {
            SmoothPlastic const model =
                test::smooth_plastic(n, Lanes(static_cast<float>(rho)), Lanes(static_cast<float>(depth)));
            for (double angle : {0., 60.}) {
                double const F = fresnel(std::cos(radians(angle)), 1.5, 0.0).unpolarised();
                double const walked = (1 - F) * random_walk(1.5, rho, depth, angle, 40000);
                INFO("depth " << depth << ", rho " << rho << " at " << angle);
                CHECK(smooth_albedo(model, angle, 0) - F == Approx(walked).epsilon(2e-2).margin(1e-4));
            }
        }
}

// Fails without the factor 1 - R(wi), and for R of Fresnel's equations at the angle of the surface.
TEST_CASE("a white base under a clear rough coat stays white", "[law]") {
    Lanes const n = test::coat_indices();
    for (float alpha : {.05f, .2f, .5f, 1.0f}) {
        RoughPlastic const white = test::rough_plastic(n, Lanes(1), alpha);
        Ggx const ggx(alpha);
        for (double angle : {0., 30., 60., 80., 88.}) {
            // The lobe alone, and all: the coat's lobe is narrow, so it is summed over visible normals.
            Direction const wo = test::at_angle(angle);
            constexpr int steps = 128;
            std::array<double, lane_count> sum{};
            for (int i = 0; i < steps; ++i)
                for (int j = 0; j < steps; ++j) {
                    Sample2 const u{(static_cast<float>(i) + .5f) / steps, (static_cast<float>(j) + .5f) / steps};
                    Direction const h = ggx.visible_normal(wo, {0, u});
                    for (Direction const& wi : {Direction(2 * wo.dot(h) * h - wo), to_cosine_hemisphere(u)}) {
                        if (!(wi.z() > 0)) continue;
                        Direction const half = (wo + wi).normalized();
                        float const visible =  // of half, over its reflection's 4 <wo, half>
                            ggx.distribution(half).value / (4 * wo.z() * (1 + ggx.lambda(wo)));
                        float const p = visible + cosine_hemisphere_density(wi.z()).value;
                        BsdfValue const f = white.evaluate(wo, wi).value;
                        for (int lane = 0; lane < lane_count; ++lane)
                            sum[static_cast<std::size_t>(lane)] +=
                                static_cast<double>(f[lane] * wi.z() / p) / (steps * steps);
                    }
                }
            for (int lane = 0; lane < lane_count; ++lane) {
                INFO("alpha " << alpha << " at " << angle << ", n " << n[lane] << ": "
                              << sum[static_cast<std::size_t>(lane)]);
                CHECK(sum[static_cast<std::size_t>(lane)] == Approx(1).margin(3e-3));
            }
        }
    }
}

TEST_CASE("a rough coat's albedo becomes Fresnel's as it gets smooth", "[unit]") {
    CoatAlbedo const& smooth = test::coat_albedo(.005f);
    for (float n : {1.3f, 1.425f, 1.65f}) {
        for (double angle : {0., 30., 60., 80.}) {
            auto const cosine = static_cast<float>(std::cos(radians(angle)));
            double const F = fresnel(static_cast<double>(cosine), static_cast<double>(n), 0.0).unpolarised();
            CHECK(smooth.reflectance(Lanes(n), cosine)[0] == Approx(F).margin(2e-3));
        }
        CHECK(smooth.mean(static_cast<double>(n)) ==
              Approx(test::walsh_mean_fresnel(static_cast<double>(n))).margin(2e-3));
    }
}

// The mirror image's share is left to sample(), which must choose it as often as evaluate() says it does not. Fails for
// a density without the probability of its lobe.
TEST_CASE("a smooth coat's two lobes share the samples", "[law]") {
    SmoothPlastic const model = test::smooth_plastic(test::coat_indices(), Lanes(.5f));
    for (double angle : {0., 60., 85.}) {
        Direction const wo = test::at_angle(angle), up(0, 0, 1);
        float const diffuse = model.evaluate(wo, up).density[0] * pi;  // 1 - probability of the image
        int images = 0;
        constexpr int samples = 100000;
        for (std::uint32_t i = 0; i < samples; ++i) {
            Sampler s(SamplerKind::independent, 8, 2, i);
            auto const x = model.sample(wo, {s.next(), s.next2()});
            images += x && !x->density;
        }
        double const p = 1 - static_cast<double>(diffuse), error = std::sqrt(p * (1 - p) / samples);
        CHECK(std::abs(static_cast<double>(images) / samples - p) < 4 * error);
    }
}
