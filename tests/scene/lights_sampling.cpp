// SPDX-License-Identifier: Apache-2.0
// Light samples follow their stated density, density() agrees with sample(), and the mean of 1 / density is the solid
// angle of what can be found.
#include <fmt/format.h>

#include <catch2/catch.hpp>

#include "support/scenes.h"
#include "support/statistics.h"

using namespace iride;

namespace {

constexpr double level = 1e-5;  // of each chi-squared test: some twenty of them

// A scene of one lamp that shines to both sides.
std::unique_ptr<Scene> lamp(std::string const& shape) {
    return test::scene_from(
        R"({ "camera": { "eye": [0,0,-9], "target": [0,0,0], "field_deg": 30 }, "shapes": [ { "material": { "type": "black" }, "emission": { "radiance": 1, "two_sided": true }, )" +
        shape + " } ] }");
}

Wavelengths some_wavelengths(WavelengthGrid const& grid = WavelengthGrid::covering(visible_range)) {
    return WavelengthSampler(visible_range, visible_importance(), grid).sample(0.3f);
}

// What is seen of the lamp: a sample behind a nearer part of it finds nothing, as density() is that of the nearest.
void check_light(std::string const& shape, Vector const& from) {
    auto const scene = lamp(shape);
    Wavelengths const w = some_wavelengths(scene->grid);
    Light const& light = scene->lights.light(0);
    RayStatistics statistics;
    test::DirectionHistogram histogram(40, 80);
    int compared = 0, different = 0;
    for (std::uint32_t i = 0; i < 400000; ++i) {
        Sampler s(SamplerKind::independent, 21, 0, i);
        auto const x = light.sample(from, w, s.next2());
        auto const hit = x ? scene->accelerator->closest({from, x->wi}, statistics) : std::nullopt;
        if (!hit || std::abs(hit->distance - x->distance) > 1e-3f * x->distance) {
            histogram.add_nothing();
            continue;
        }
        histogram.add(x->wi);
        // What scattering would find in that direction has the same density; at an edge, another triangle's.
        if (i % 64 != 0) continue;
        ++compared;
        different += light.density(from, hit->point, hit->primitive).value != Approx(x->density->value).epsilon(2e-2);
    }
    INFO(shape);
    CHECK(different <= compared / 200);
    auto const density = [&](Direction const& wi) {
        auto const hit = scene->accelerator->closest({from, wi}, statistics);
        return hit ? static_cast<double>(light.density(from, hit->point, hit->primitive).value) : 0.0;
    };
    CHECK(histogram.p_value(density, 24) > level);
}

// The mean of 1 / density over the samples: the solid angle of a lamp of which every point is seen.
double sampled_solid_angle(std::string const& shape, Vector const& from) {
    auto const scene = lamp(shape);
    Wavelengths const w = some_wavelengths(scene->grid);
    double sum = 0;
    constexpr std::uint32_t samples = 1 << 14;
    for (std::uint32_t i = 0; i < samples; ++i) {
        Sampler s(SamplerKind::sobol, 22, 0, i);
        if (auto const x = scene->lights.light(0).sample(from, w, s.next2()))
            sum += 1 / static_cast<double>(x->density->value);
    }
    return sum / samples;
}

}  // namespace

// Fails for 1 / solid angle where the rectangle is sampled by area.
TEST_CASE("a rectangle lamp is sampled uniformly in solid angle", "[law]") {
    check_light(R"("type": "quad", "corners": [[-1,1,-1],[1,1,-1],[1,1,1.5],[-1,1,1.5]])", {0.3f, 0, 0.2f});
}
TEST_CASE("a crooked quad lamp is sampled by its two triangles", "[law]") {
    check_light(R"("type": "quad", "corners": [[-1,1,-1],[1.4,1,-0.8],[1,1,1.5],[-1.2,1,1]])", {0.1f, 0, 0.2f});
}
// Fails for directions over the whole sphere's surface with the cone's density.
TEST_CASE("a sphere lamp is sampled uniformly in its cone", "[law]") {
    check_light(R"("type": "sphere", "centre": [0.3,1.5,0.2], "radius": 0.9)", {0, 0, 0});
}
TEST_CASE("a sphere lamp seen from inside is sampled by area", "[law]") {
    check_light(R"("type": "sphere", "centre": [0.3,0.2,0.1], "radius": 0.9)", {0, 0, 0});
}
// Fails for a density without the cosine at the lamp.
TEST_CASE("a disc lamp is sampled by area", "[law]") {
    check_light(R"("type": "disc", "centre": [0.3,1.1,0.2], "normal": [0.2,-1,0.1], "radius": 0.9)", {0, 0, 0});
}
// Seen from inside: a silhouette, where the density goes to infinity, is beyond the histogram's quadrature.
TEST_CASE("a cylinder lamp is sampled by area", "[law]") {
    check_light(R"("type": "cylinder", "from": [-0.6,-0.2,0.1], "to": [0.9,0.4,0.4], "radius": 0.5, "caps": false)",
                {0.1f, 0.2f, 0.1f});
}
// Fails for a height drawn evenly along the axis.
TEST_CASE("a cone lamp is sampled by area", "[law]") {
    check_light(R"("type": "cone", "from": [0.2,-0.4,0.1], "to": [0.3,1.6,0.4], "radius": 0.9, "caps": false)",
                {0.1f, 0.1f, 0});
    check_light(
        R"("type": "cone", "from": [0.2,-0.4,0.1], "to": [0.3,1.6,0.4], "radius": 0.6, "top_radius": 1.1, "caps": false)",
        {0.1f, 0.3f, 0});
}
TEST_CASE("a triangle lamp is sampled uniformly in solid angle", "[law]") {
    check_light(R"("type": "mesh", "vertices": [[-1,1,-1],[1.4,1.2,-0.8],[0.3,0.9,1.5]], "triangles": [[0,1,2]])",
                {0.1f, 0, 0.2f});
}
// Fails when either sample() or density() leaves out the probability of the triangle.
TEST_CASE("a mesh lamp is sampled by area and each triangle uniformly in solid angle", "[law]") {
    check_light(
        R"("type": "mesh", "vertices": [[-1,1,-1],[1.4,1.2,-0.8],[0.3,0.9,1.5],[0.2,2.4,0.1]], "triangles": [[0,1,2],[0,1,3],[1,2,3],[2,0,3]])",
        {0.1f, 0, 0.2f});
}

// Of the directions to a ceiling from a wall at its side. Fails for a density that is not the sampled one's.
TEST_CASE("a rectangle asked with a normal finds the same irradiance with less noise", "[law]") {
    auto const scene = lamp(R"("type": "quad", "corners": [[-1,1,-1],[1,1,-1],[1,1,1.5],[-1,1,1.5]])");
    Wavelengths const w = some_wavelengths(scene->grid);
    Direction const n(-1, 0, 0);
    constexpr int samples = 1 << 14;
    auto const irradiance = [&](Vector const& normal) {
        return test::replicated(samples, [&](int i) {
            Sample2 const u = Sampler(SamplerKind::independent, 23, 0, static_cast<std::uint32_t>(i)).next2();
            LightRequest request{{0.9f, 0.1f, 0.2f}, u, &w};
            request.normal = normal;
            scene->lights.light(0).answer({&request, 1});
            REQUIRE(request.sample);
            return static_cast<double>(std::max(0.0f, request.sample->wi.dot(n)) / request.sample->density->value);
        });
    };
    test::Replicated const even = irradiance(Vector(0, 0, 0)), preferring = irradiance(n);
    CHECK(std::abs(even.mean - preferring.mean) < 4 * std::hypot(even.error, preferring.error));
    CHECK(preferring.error < even.error / 2);
}

// Closed forms, near (by solid angle) and so far that lamps are sampled by area. Fails for a density by area without
// the cosine.
TEST_CASE("the mean of one over the density is the lamp's solid angle", "[law]") {
    for (double d : {0.7, 3.0, 60.0, 900.0}) {
        INFO("at distance " << d);
        float const z = static_cast<float>(d);
        double const a = 0.5, b = 0.3;  // half sides; [Oosterom 1983] of the four triangles is this
        CHECK(sampled_solid_angle(R"("type": "quad", "corners": [[-0.5,-0.3,0],[0.5,-0.3,0],[0.5,0.3,0],[-0.5,0.3,0]])",
                                  {0, 0, z}) ==
              Approx(4 * std::atan(a * b / (d * std::sqrt(a * a + b * b + d * d)))).epsilon(1e-3));
        // A right triangle seen from above its right angle.
        CHECK(sampled_solid_angle(
                  R"("type": "mesh", "vertices": [[0,0,0],[0.5,0,0],[0,0.3,0]], "triangles": [[0,1,2]])", {0, 0, z}) ==
              Approx(2 * std::atan2(a * b * d, d * (std::hypot(a, d) * std::hypot(b, d)) +
                                                   d * d * (std::hypot(a, d) + std::hypot(b, d)) + d * d * d))
                  .epsilon(1e-3));
        CHECK(
            sampled_solid_angle(R"("type": "disc", "centre": [0,0,0], "normal": [0,0,1], "radius": 0.5)", {0, 0, z}) ==
            Approx(2 * pi_double * a * a / (std::hypot(a, d) * (std::hypot(a, d) + d))).epsilon(1e-3));
        CHECK(sampled_solid_angle(R"("type": "sphere", "centre": [0,0,0], "radius": 0.5)", {0, 0, z}) ==
              Approx(2 * pi_double * a * a / (d * (d + std::sqrt(d * d - a * a)))).epsilon(1e-3));
    }
}

// Fails for directions over the whole sphere's surface with the cone's density.
TEST_CASE("a far sphere lamp gives the irradiance pi L (r / d)^2", "[law]") {
    auto const scene = test::scene_from(
        R"({ "camera": { "eye": [0,5,0], "target": [0,0,0], "up": [0,0,1], "field_deg": 0.1 }, "film": { "size": [2,2] },
        "shapes": [ { "type": "quad", "corners": [[-1,0,-1],[-1,0,1],[1,0,1],[1,0,-1]], "material": { "type": "diffuse", "reflectance": 1 } },
                    { "type": "sphere", "centre": [0,200,0], "radius": 1, "material": { "type": "black" }, "emission": { "radiance": 10000 } } ] })");
    Film const film = test::rendered(*scene, "path", {.spp = 4096, .seed = 6});
    double const error = std::sqrt(film.variance(0, 0).Y), small = square(1 / 200.0);  // cosines differ from 1 by less
    CHECK(std::abs(film.mean(0, 0).Y - 10000.0 / (200.0 * 200)) < 3.3 * error + small);  // two-sided level 1e-3
    CHECK(error < 1e-3);
}

namespace {

// sample() against arriving_density(), and the radiance of both.
void check_environment(Light const& light) {
    Wavelengths const w = some_wavelengths();
    test::DirectionHistogram histogram(40, 80);
    for (std::uint32_t i = 0; i < 400000; ++i) {
        Sampler s(SamplerKind::independent, 23, 0, i);
        auto const x = light.sample({1, 2, 3}, w, s.next2());
        REQUIRE(x);
        REQUIRE(x->density);
        histogram.add(x->wi);
        if (i % 64 != 0) continue;
        CHECK(x->distance == infinity);
        CHECK(x->wi.norm() == Approx(1).epsilon(1e-5));
        CHECK(x->density->value == Approx(light.arriving_density(x->wi).value).epsilon(1e-3));
        CHECK(x->radiance[0] == Approx(light.arriving(x->wi, w)[0]).epsilon(1e-5));
    }
    auto const density = [&](Direction const& wi) { return static_cast<double>(light.arriving_density(wi).value); };
    CHECK(histogram.integral_of(density, 24) == Approx(1).epsilon(2e-3));
    CHECK(histogram.p_value(density, 24) > level);
}

Emission flat_emission() { return Emission(1.0f); }

}  // namespace

TEST_CASE("a constant environment is sampled uniformly over the sphere", "[law]") {
    auto const light = make_constant_environment(Emission(2.5f), 2.5);
    check_environment(*light);
    CHECK(light->arriving_density(Direction(0, 0, 1)).value == Approx(1 / (4 * pi_double)));
    CHECK(light->arriving(Direction(0, 1, 0), some_wavelengths())[0] == 2.5f);
}

// Rows and columns lie on the histogram's meridians, whose axis is z, only by chance; 8 x 4 texels, some of them black.
// Independent of the code: the density is piecewise constant in the picture, Y sin(row) / sum over the 2 pi^2
// sin(polar) sr of the unit square. Fails without sin(polar) in the density or in the
// weights of the rows, and for a rotation the other way.
TEST_CASE("a picture environment is sampled by luminance", "[law]") {
    constexpr int width = 8, height = 4;
    EnvironmentPicture picture{width, height, {}, {flat_emission(), flat_emission(), flat_emission()}, 0.7f};
    for (int i = 0; i < width * height; ++i)
        picture.texel.push_back({static_cast<float>(i % 5), 0.3f * static_cast<float>(i % 3),
                                 i % 7 == 0 ? 4.0f : 0.1f * static_cast<float>(i % 2)});
    auto const luminance = [&](int i) {
        auto const& t = picture.texel[static_cast<std::size_t>(i)];
        return 0.2126 * static_cast<double>(t[0]) + 0.7152 * static_cast<double>(t[1]) +
               0.0722 * static_cast<double>(t[2]);
    };
    double total = 0;
    for (int i = 0; i < width * height; ++i)
        total += luminance(i) * std::sin(pi_double * (i / width + 0.5) / height) / (width * height);
    auto const light = make_picture_environment(picture);
    Wavelengths const w = some_wavelengths();
    check_environment(*light);
    for (int row = 0; row < height; ++row)
        for (int column = 0; column < width; ++column)
            for (double part : {0.1, 0.6}) {
                // Row 0 at +y; the centre column looks to -z, columns run to +x; rotation about y carries that along.
                double const polar = pi_double * (row + part) / height;
                double const azimuth = 2 * pi_double * ((column + part) / width - 0.5) + static_cast<double>(0.7f);
                Direction const wi = VectorDouble(std::sin(polar) * std::sin(azimuth), std::cos(polar),
                                                  -std::sin(polar) * std::cos(azimuth))
                                         .cast<float>();
                int const i = row * width + column;
                auto const& t = picture.texel[static_cast<std::size_t>(i)];
                double const weight = luminance(i) * std::sin(pi_double * (row + 0.5) / height);
                INFO("row " << row << ", column " << column);
                CHECK(light->arriving(wi, w)[0] == Approx(t[0] + t[1] + t[2]).margin(1e-6));
                CHECK(light->arriving_density(wi).value ==
                      Approx(weight / total / (2 * square(pi_double) * std::sin(polar))).epsilon(1e-4).margin(1e-9));
            }
}

// Intensity 3, inverse square, full within 10 degrees, then 3 t^2 - 2 t^3 in the cosine down to 40 degrees. Fails for a
// linear falloff.
TEST_CASE("a spot light falls off by its cubic and the inverse square of the distance", "[unit]") {
    float const cos_full = static_cast<float>(std::cos(radians(10))),
                cos_end = static_cast<float>(std::cos(radians(40)));
    Vector const position(1, 2, 3);
    auto const light =
        make_spot_light(position, {Direction(0, -1, 0), cos_full, cos_end}, Spectrum<dim::spectral_intensity>(3.0f), 3);
    Wavelengths const w = some_wavelengths();
    for (double degrees : {0., 5., 9.9, 12., 25., 33., 39.9, 40.1, 80., 120., 180.})
        for (double r : {0.5, 2.0, 30.0}) {
            double const a = radians(degrees);
            Vector const from = position + VectorDouble(r * std::sin(a), -r * std::cos(a), 0).cast<float>();
            double const t = std::clamp(
                (std::cos(a) - static_cast<double>(cos_end)) / static_cast<double>(cos_full - cos_end), 0.0, 1.0);
            double const expected = 3 * t * t * (3 - 2 * t) / (r * r);
            auto const x = light->sample(from, w, {.2f, .8f});
            INFO(degrees << " degrees, " << r << " m");
            CHECK(x.has_value() == (degrees < 40));
            if (!x) continue;
            CHECK(x->radiance[0] == Approx(expected).epsilon(1e-4).margin(1e-6 / (r * r)));
            CHECK(x->distance == Approx(r).epsilon(1e-5));
            CHECK((from + x->distance * x->wi - position).norm() < 1e-5f * static_cast<float>(r) + 1e-6f);
            CHECK(!x->density);
        }
}

TEST_CASE("a point light gives intensity over the squared distance in every direction", "[unit]") {
    auto const light = make_point_light({1, 2, 3}, Spectrum<dim::spectral_intensity>(6.0f), 6);
    for (Vector const& offset : {Vector(0, 0, 2), Vector(0, 0, -2), Vector(0, 3, 4), Vector(-8, 0, 0)}) {
        auto const x = light->sample(Vector(1, 2, 3) + offset, some_wavelengths(), {.5f, .5f});
        REQUIRE(x);
        CHECK(x->radiance[0] == Approx(6 / offset.squaredNorm()).epsilon(1e-6));
        CHECK((x->wi + offset.normalized()).norm() < 1e-6f);
    }
    CHECK(!light->sample({1, 2, 3}, some_wavelengths(), {.5f, .5f}));  // in the light itself
}

TEST_CASE("a distant light gives its irradiance from one direction everywhere", "[unit]") {
    Direction const travel = Vector(1, -2, 2) / 3;
    auto const light = make_distant_light(travel, Spectrum<dim::spectral_irradiance>(0.75f), 0.75);
    for (Vector const& from : {Vector(0, 0, 0), Vector(1e3f, -5, 7)}) {
        auto const x = light->sample(from, some_wavelengths(), {.1f, .9f});
        REQUIRE(x);
        CHECK(x->radiance[0] == 0.75f);
        CHECK(x->wi == Direction(-travel));
        CHECK(x->distance == infinity);
        CHECK(!x->density);
    }
}

// Fails for a choice by number instead of power.
TEST_CASE("lights are chosen by their luminous power", "[law]") {
    auto const scene = test::scene_from(
        R"({ "camera": { "eye": [0,0,-9], "target": [0,0,0], "field_deg": 30 }, "shapes": [
          { "type": "sphere", "centre": [0,0,0], "radius": 2, "material": { "type": "black" }, "emission": { "radiance": 1 } },
          { "type": "quad", "corners": [[5,0,0],[6,0,0],[6,1,0],[5,1,0]], "material": { "type": "black" }, "emission": { "radiance": 4 } },
          { "type": "disc", "centre": [9,0,0], "normal": [0,1,0], "radius": 1, "material": { "type": "black" }, "emission": { "radiance": 2, "two_sided": true } } ],
          "lights": [ { "type": "point", "position": [0,9,0], "intensity": 5 } ] })");
    // pi A L sides, 4 pi I.
    std::vector<double> const power{16 * square(pi_double), 4 * pi_double, 4 * square(pi_double), 20 * pi_double};
    double total = 0;
    for (double p : power) total += p;
    test::ChiSquared verdict;
    std::vector<double> count(4);
    constexpr int draws = 100000;
    for (std::uint32_t i = 0; i < draws; ++i) {
        auto const choice = scene->lights.choose(Sampler(SamplerKind::independent, 24, 0, i).next());
        ++count[static_cast<std::size_t>(choice.index)];
        REQUIRE(choice.probability == scene->lights.probability(choice.index));
    }
    for (int i = 0; i < 4; ++i) {
        double const p = power[static_cast<std::size_t>(i)] / total;
        CHECK(scene->lights.probability(i) == Approx(p).epsilon(1e-5));
        verdict.add(draws * p, count[static_cast<std::size_t>(i)]);
    }
    CHECK(verdict.p_value() > level);
}
