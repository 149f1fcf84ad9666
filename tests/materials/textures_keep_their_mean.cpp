// SPDX-License-Identifier: Apache-2.0
// Levels keep the mean of a picture, look-ups find the texels they should, and averages are those of many points.
#include <catch2/catch.hpp>

#include "base/random.h"
#include "materials/textures.h"

using namespace iride;

namespace {

float uniform(std::uint64_t a, std::uint64_t b) { return to_unit_float(static_cast<std::uint32_t>(hash_words(a, b))); }

std::shared_ptr<PictureScalar::Pyramid> random_picture(int width, int height) {
    TextureLevel<float> level{width, height, {}};
    for (int i = 0; i < width * height; ++i) level.texel.push_back(uniform(1, static_cast<std::uint64_t>(i)));
    auto picture = std::make_shared<PictureScalar::Pyramid>();
    picture->level.push_back(level);
    while (picture->level.back().width > 1 || picture->level.back().height > 1)
        picture->level.push_back(halved(picture->level.back()));
    return picture;
}
double mean(TextureLevel<float> const& level) {
    double sum = 0;
    for (float t : level.texel) sum += static_cast<double>(t);
    return sum / static_cast<double>(level.texel.size());
}
SurfacePoint at_uv(float u, float v) {
    SurfacePoint point;
    point.uv = {u, v};
    return point;
}

}  // namespace

TEST_CASE("every level has the mean of the picture, whatever its size", "[unit]") {
    for (auto [width, height] : {std::pair(64, 64), {37, 51}, {1, 9}, {100, 3}}) {
        auto const picture = random_picture(width, height);
        for (auto const& level : picture->level) CHECK(mean(level) == Approx(mean(picture->level[0])).epsilon(1e-5));
        CHECK(picture->level.back().texel.size() == 1);
    }
}

TEST_CASE("texel centres return their texels, the top row at v = 1", "[unit]") {
    auto const picture = random_picture(8, 4);
    for (TextureFilter filter : {TextureFilter::trilinear, TextureFilter::bilinear, TextureFilter::nearest})
        for (Wrap wrap : {Wrap::repeat, Wrap::clamp, Wrap::mirror}) {
            PictureScalar const map(picture, {.wrap = wrap, .filter = filter}, {0, 1});
            for (int y = 0; y < 4; ++y)
                for (int x = 0; x < 8; ++x)
                    CHECK(map.at(at_uv((static_cast<float>(x) + .5f) / 8, 1 - (static_cast<float>(y) + .5f) / 4)) ==
                          Approx(picture->level[0].at(x, y)).margin(1e-6));
        }
}

TEST_CASE("beyond the picture it repeats, holds its edge, or is mirrored", "[unit]") {
    auto const picture = random_picture(8, 4);
    auto const value = [&](Wrap wrap, float u, float v) {
        return PictureScalar(picture, {.wrap = wrap}, {0, 1}).at(at_uv(u, v));
    };
    for (auto const& [u, v] : {std::pair(.3f, .8f), {.02f, .98f}, {.51f, .03f}}) {
        CHECK(value(Wrap::repeat, u + 3, v - 5) == Approx(value(Wrap::repeat, u, v)).margin(1e-4));
        CHECK(value(Wrap::mirror, -u, 2 - v) == Approx(value(Wrap::mirror, u, v)).margin(1e-4));
        CHECK(value(Wrap::mirror, u + 2, v) == Approx(value(Wrap::mirror, u, v)).margin(1e-4));
        CHECK(value(Wrap::clamp, u + 7, v) == Approx(value(Wrap::clamp, 1, v)).margin(1e-6));
    }
    CHECK(value(Wrap::repeat, 1e9f, -1e30f) >= 0);
}

// The footprint of a ray that sees 8 texels: as good as the mean of the points in it, where one point is not.
TEST_CASE("a wide footprint averages the picture", "[law]") {
    auto const picture = random_picture(64, 64);
    PictureScalar const map(picture, {}, {0, 1});
    double squares = 0, of_points = 0;
    for (std::uint64_t i = 0; i < 200; ++i) {
        SurfacePoint point = at_uv(uniform(2, i), uniform(3, i));
        double mean_of_points = 0;
        for (std::uint64_t k = 0; k < 256; ++k)
            mean_of_points += static_cast<double>(map.at(at_uv(point.uv.x() + (uniform(4, 256 * i + k) - .5f) / 8,
                                                               point.uv.y() + (uniform(5, 256 * i + k) - .5f) / 8))) /
                              256;
        of_points += square(static_cast<double>(map.at(point)) - mean_of_points);
        point.across_ray = {1 / 8.f, 0};
        point.along_ray = {0, 1 / 8.f};
        squares += square(static_cast<double>(map.at(point)) - mean_of_points);
    }
    CHECK(squares < of_points / 25);
}

TEST_CASE("a checker's average is that of many points of the box", "[law]") {
    Checker const checker(Vector2(3, 5));
    CHECK(checker.at(at_uv(.1f, .1f)) == 0);
    CHECK(checker.at(at_uv(.4f, .1f)) == 1);
    CHECK(checker.at(at_uv(.4f, .3f)) == 0);
    CHECK(checker.at(at_uv(-.1f, .1f)) == 1);
    for (std::uint64_t i = 0; i < 20; ++i) {
        SurfacePoint point = at_uv(uniform(6, i), uniform(7, i));
        float const width = uniform(8, i), height = uniform(9, i) / 2;
        double mean_of_points = 0;
        int const n = 200;
        for (int k = 0; k < n * n; ++k)
            mean_of_points += static_cast<double>(checker.at(
                                  at_uv(point.uv.x() + width * ((static_cast<float>(k % n) + .5f) / n - .5f),
                                        point.uv.y() + height * ((static_cast<float>(k / n) + .5f) / n - .5f)))) /
                              (n * n);
        point.across_ray = {width, 0};
        point.along_ray = {0, height};
        CHECK(static_cast<double>(checker.at(point)) == Approx(mean_of_points).margin(.006));
    }
}

TEST_CASE("a mix by weights is linear in the spectra", "[unit]") {
    WavelengthGrid const grid = WavelengthGrid::covering(visible_range);
    Wavelengths const w = WavelengthSampler(visible_range, visible_importance(), grid).sample(.3f);
    MixedReflectance const mix(ScalarMap(0.25f), Reflectance(0.8f), Reflectance(0.4f));
    CHECK(mix.at(at_uv(0, 0), w)[3] == Approx(0.7));
}
