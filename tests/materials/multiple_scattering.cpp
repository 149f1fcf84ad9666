// SPDX-License-Identifier: Apache-2.0
// What light that meets several facets brings back. Each was seen to fail once: with the lobe m doubled (furnace), with
// mean_loss for loss(wi) in it (reciprocity), with the table's quadrature uniform in y (table), with F_avg instead of
// its square in F_ms (random walk).
#include <catch2/catch.hpp>

#include "base/sampler.h"
#include "materials/rough_dielectric.h"
#include "support/conductors.h"
#include "support/dielectrics.h"

using namespace iride;

namespace {

constexpr std::array<float, 7> roughnesses{.05f, .1f, .2f, .3f, .5f, .7f, 1.0f};

Direction at_cosine(double cosine, double azimuth = 0) {
    auto const sine = std::sqrt((1 - cosine) * (1 + cosine));
    return VectorDouble(sine * std::cos(azimuth), sine * std::sin(azimuth), cosine).cast<float>();
}
Direction at_angle(double degrees, double azimuth = 0) { return at_cosine(std::cos(radians(degrees)), azimuth); }

// Facets of every kind. The names are for messages.
std::vector<std::pair<std::string, Facets>> kinds_of_facets() {
    std::vector<std::pair<std::string, Facets>> all;
    for (Masking const masking : {Masking::smith, Masking::v_cavity})
        for (FacetShape const shape : {FacetShape::ggx, FacetShape::beckmann}) {
            std::string const name = (shape == FacetShape::ggx ? std::string("ggx") : std::string("beckmann")) +
                                     (masking == Masking::smith ? "" : ", v-cavity");
            for (float alpha : {.001f, .01f, .05f, .2f, .5f, 1.0f})
                all.push_back({name + " " + std::to_string(alpha), {{{1, alpha, alpha}}, shape, masking}});
            all.push_back({name + ", brushed", {{{1, .05f, .3f}}, shape, masking}});
            all.push_back({name + ", mixed", {{{.5f, .02f, .02f}, {.3f, .2f, .2f}, {.2f, 1, .8f}}, shape, masking}});
        }
    return all;
}

// What facets do with light, without what is lost between them: where visible normals send it, the density there, and
// how much of it gets away. A second writing of the models' single scattering, by the textbook.
struct OneBounce {
    Facets const& facets;
    std::optional<double> eta;  // n(far) / n(near); absent: mirrors

    struct Way {
        Direction wi;
        double kept;
    };
    Way sampled(Direction const& wo, Sample3 u, float choice) const {
        Direction const h = facets.visible_normal(wo, u);
        float const cosine = wo.dot(h), lambda_o = facets.lambda(wo, h);
        float const relative = eta ? static_cast<float>(1 / *eta) : 1, sine2 = square(relative) * (1 - square(cosine));
        float const F =
            !eta || sine2 >= 1 ? 1 : fresnel(std::min(1.0f, cosine), static_cast<float>(*eta), 0.0f).unpolarised();
        bool const reflected = choice < F;
        Direction const wi = (reflected ? Vector(2 * cosine * h - wo)
                                        : Vector((relative * cosine - std::sqrt(1 - sine2)) * h - relative * wo))
                                 .normalized();
        if ((wi.z() > 0) != reflected) return {wi, 0};
        float const lambda_i = facets.lambda(wi, h);
        return {wi, static_cast<double>(reflected ? (1 + lambda_o) / (1 + facets.joint(lambda_o, lambda_i))
                                                  : 1 / (1 + lambda_i))};
    }
    // Of reflected and refracted directions at equal odds, before anything is blocked [1/sr].
    double density(Direction const& wo, Direction const& wi) const {
        auto const visible = [&](Direction const& h) {
            return static_cast<double>(facets.distribution(h).value / (1 + facets.lambda(wo, h)) *
                                       std::max(0.0f, wo.dot(h)) / wo.z());
        };
        if (wi.z() > 0) {
            Direction const h = (wo + wi).normalized();
            return visible(h) / (4 * static_cast<double>(wo.dot(h)));
        }
        if (!eta) return 0;
        Vector const sum = wo + static_cast<float>(*eta) * wi;
        Direction const h = sum / std::copysign(sum.norm(), sum.z());
        if (!(wo.dot(h) > 0 && wi.dot(h) < 0)) return 0;
        return visible(h) * square(*eta) * static_cast<double>(-wi.dot(h) / sum.squaredNorm());
    }
    double loss_by_samples(Direction const& wo, std::uint32_t samples) const {
        double kept = 0;
        for (std::uint32_t i = 0; i < samples; ++i) {
            Sampler s(SamplerKind::sobol, 11, 4, i);
            float const choice = s.next();
            kept += sampled(wo, {s.next(), s.next2()}, choice).kept;
        }
        return 1 - kept / samples;
    }
};

// int of a model's density over all wi, blind to its sample(): from visible normals, from the lobe of several bounces,
// and from a cosine, joined by the balance heuristic. wo.z > 0, above which the facets and the losses `near` lie.
template <class Density>
double total(OneBounce const& bounce, FacetLoss const& near, FacetLoss const& far, Direction const& wo,
             Density&& density, std::uint32_t samples) {
    bool const through = bounce.eta.has_value();
    double sum = 0;
    for (std::uint32_t i = 0; i < samples; ++i) {
        Sampler s(SamplerKind::sobol, 3, 1, i);
        Sample2 const side = s.next2(), u = s.next2();
        bool const crosses = through && side.x < .5f;
        auto const turned = [&](Direction w) {
            if (crosses) w.z() = -w.z();
            return w;
        };
        Sample3 of_normal{side.y, u};
        Direction const h = bounce.facets.visible_normal(wo, of_normal);
        float const cosine = wo.dot(h);
        std::array<Direction, 3> ways{2 * cosine * h - wo, turned((crosses ? far : near).sample(u)),
                                      turned(to_cosine_hemisphere(u))};
        if (crosses) {
            float const relative = static_cast<float>(1 / *bounce.eta), sine2 = square(relative) * (1 - square(cosine));
            ways[0] = sine2 < 1 ? Direction((relative * cosine - std::sqrt(1 - sine2)) * h - relative * wo)
                                : Direction(0, 0, 0);
        }
        for (std::size_t k = 0; k < ways.size(); ++k) {
            Direction const& wi = ways[k];
            if (wi.z() == 0 || (wi.z() < 0) != crosses) continue;
            FacetLoss const& loss = crosses ? far : near;
            double const cosine_i = std::abs(static_cast<double>(wi.z()));
            double const p = bounce.density(wo, wi) + cosine_i / pi_double +
                             cosine_i / pi_double * static_cast<double>(loss.loss(wi) / loss.mean());
            sum += density(wi) / p * (through ? 2 : 1);
        }
    }
    return sum / samples;
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
        Direction const h = ggx.visible_normal(-ray, Sample3{0, s.next2()});
        float const cosine = -ray.dot(h);
        weight *= fresnel_unpolarised(std::clamp(cosine, 0.0f, 1.0f), n, k);
        ray = (ray + 2 * cosine * h).normalized();
    }
    return Lanes(0);
}

}  // namespace

// At every roughness and angle, of every kind.
TEST_CASE("a white rough metal in a white furnace stays white", "[law]") {
    for (auto const& [name, facets] : kinds_of_facets()) {
        RoughMetal<BareFresnel, FacetsOfMaterial> const model =
            test::interreflecting(Lanes(1e-3f), Lanes(1000), facets);
        for (double angle : {0., 30., 60., 80., 89., 89.9}) {
            Direction const wo = at_angle(angle, .4);
            double const albedo = total(
                {facets, std::nullopt}, *model.loss, *model.loss, wo,
                [&](Direction const& wi) { return static_cast<double>(model.evaluate(wo, wi).value[0] * wi.z()); },
                1 << 15);
            INFO(name << " at " << angle << ": " << albedo);
            CHECK(std::abs(albedo - 1) < 5e-3);
        }
    }
}

// The density is f cos wi times n_i^2 over n_o^2: a furnace of L / n^2 in which the surface is not seen.
TEST_CASE("a rough glass in a furnace of L / n^2 disappears", "[law]") {
    for (double const n : {1.1, 1.5, 2.4})
        for (float alpha : {.001f, .01f, .1f, .3f, .6f, 1.0f}) {
            Facets const facets = Facets::ggx(alpha, alpha);
            auto const above = shared_facet_loss(facets, n), below = shared_facet_loss(facets, 1 / n);
            BoundaryLoss const losses(facets, n, n);
            RoughDielectric<Ggx> const model{Lanes(static_cast<float>(n)), Lanes(1), alpha, &losses};
            for (bool outside : {true, false})
                for (double angle : {0., 30., 60., 80., 89., 89.9}) {
                    Direction const wo = at_angle(angle, .4);
                    auto const turned = [&](Direction const& w) {
                        return outside ? w : Direction(w.x(), w.y(), -w.z());
                    };
                    double const all = total(
                        {facets, outside ? n : 1 / n}, outside ? *above : *below, outside ? *below : *above, wo,
                        [&](Direction const& wi) {
                            return static_cast<double>(model.evaluate(turned(wo), turned(wi)).density[0]);
                        },
                        1 << 15);
                    INFO("n " << n << " alpha " << alpha << " at " << angle << (outside ? "" : " inside") << ": "
                              << all);
                    CHECK(std::abs(all - 1) < 5e-3);
                }
        }
}

// The samples' own error is up to half of the bound.
TEST_CASE("the table of lost light keeps its error bound", "[law]") {
    std::vector<double> const cosines{.0003, .002, .0123, .05, .111, .27, .456, .789, .95, 1.};
    auto const check = [&](std::string const& name, Facets const& facets, std::optional<double> eta, double bound) {
        FacetLoss const table(facets, eta);
        for (double cosine : cosines) {
            Direction const w = at_cosine(cosine, .7);
            double const found = static_cast<double>(table.loss(w)),
                         expected = OneBounce{facets, eta}.loss_by_samples(
                             w, facets.components.size() > 1 ? 1 << 18 : 1 << 16);
            INFO(name << " cosine " << cosine << ": " << found << ", expected " << expected);
            CHECK(std::abs(found - expected) < bound);
        }
    };
    for (auto const& [name, facets] : kinds_of_facets()) check(name, facets, std::nullopt, 2e-3);
    for (double eta : {1.5, 1 / 1.5})
        for (float alpha : {.01f, .2f, 1.0f}) check("glass", Facets::ggx(alpha, alpha), eta, 2e-3);
}

TEST_CASE("the table has the published albedos of one scattering", "[unit]") {
    auto const albedo = [](float alpha, float cosine) {
        return 1 - test::facet_loss(Facets::ggx(alpha, alpha)).loss(at_cosine(static_cast<double>(cosine)));
    };
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
            Lanes const once = albedo_by_samples(RoughConductor{n, k, alpha}, at_angle(angle), 1 << 14);
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
