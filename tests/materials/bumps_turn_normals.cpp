// SPDX-License-Identifier: Apache-2.0
// Bump maps turn a normal by Blinn's formula, and what that leaves out of a truly displaced surface is what it should
// be; normal maps give the normal they hold.
#include <catch2/catch.hpp>

#include "materials/relief.h"
#include "materials/textures.h"

using namespace iride;

namespace {

// The unit sphere at latitude 45 degrees, pole on z as in the exercise: u runs with the longitude, v with the latitude
// over half a turn.
SurfacePoint on_sphere(float latitude) {
    float const c = std::cos(latitude), s = std::sin(latitude);
    SurfacePoint point{{c, 0, s}, {c, 0, s}, {c, 0, s}};
    point.uv = {0.5f, 0.5f + latitude / pi};
    point.dp_du = 2 * pi * Vector(0, c, 0);
    point.dp_dv = pi * Vector(-s, 0, c);
    point.tangent = {0, 1, 0};
    return point;
}

// sin^2(latitude) = (1 + cos 2 pi v) / 2.
ScalarMap sine_squared() { return ScalarMap(std::make_shared<Waves>(Vector2(0, 1))); }

}  // namespace

// Fails with the gradient's sign turned.
TEST_CASE("height sin^2(latitude) / 10 turns the sphere's normal as the exercise says", "[unit]") {
    SurfacePoint const point = on_sphere(pi / 4);
    CHECK(sine_squared().at(point) == Approx(.5));
    Direction const bumped = BumpMap(sine_squared(), 0.1f).normal_at(point);
    CHECK(bumped.x() == Approx(.7739573).epsilon(1e-6));
    CHECK(bumped.y() == Approx(0).margin(1e-7));
    CHECK(bumped.z() == Approx(.6332378).epsilon(1e-6));
}

// Blinn adds h' n to dp/du and leaves out h dn/du, so on a sphere of radius r his slope is h' / r where the displaced
// surface p + h n has h' / (r + h): here .1 against .1 / 1.05. The exact normal, from the displaced surface itself by
// differences in double, is the exercise's, and it is Blinn's for the height h r / (r + h).
TEST_CASE("the truly displaced sphere has the exercise's exact normal, between Blinn's and the sphere's", "[unit]") {
    auto const displaced = [](double longitude, double latitude) {
        double const r = 1 + square(std::sin(latitude)) / 10;
        return VectorDouble(r * std::cos(latitude) * std::cos(longitude), r * std::cos(latitude) * std::sin(longitude),
                            r * std::sin(latitude));
    };
    double const at = pi_double / 4, e = 1e-5;
    VectorDouble const exact =
        (displaced(e, at) - displaced(-e, at)).cross(displaced(0, at + e) - displaced(0, at - e)).normalized();
    CHECK(exact.x() == Approx(.7709618).epsilon(1e-6));
    CHECK(exact.z() == Approx(.6368814).epsilon(1e-6));
    Direction const scaled = BumpMap(sine_squared(), 0.1f / 1.05f).normal_at(on_sphere(pi / 4));
    CHECK((scaled.cast<double>() - exact).norm() < 1e-6);
    // The difference goes with the height, 1 : 1 + h, not with the slope: it is gone for a fine relief.
    Direction const fine = BumpMap(sine_squared(), 1e-4f).normal_at(on_sphere(pi / 4));
    CHECK((fine - Vector(1, 0, 1).normalized()).norm() == Approx(1e-4).epsilon(1e-3));
}

TEST_CASE("a picture of heights has the slopes of the surface it is", "[unit]") {
    // 64 x 64 texels of a plane 3 u + 2 v and of nothing else; away from the edge, where it repeats.
    auto picture = std::make_shared<PictureScalar::Pyramid>();
    TextureLevel<float> level{64, 64, {}};
    for (int y = 0; y < 64; ++y)
        for (int x = 0; x < 64; ++x)
            level.texel.push_back(3 * (static_cast<float>(x) + .5f) / 64 +
                                  2 * (1 - (static_cast<float>(y) + .5f) / 64));
    picture->level.push_back(level);
    ScalarMap const map(std::make_shared<PictureScalar>(picture, TextureMapping{}, ScalarRange{0, 5}));
    SurfacePoint point;
    for (Vector2 const& uv : {Vector2(.3f, .4f), Vector2(.51f, .77f), Vector2(.9f, .1f)}) {
        point.uv = uv;
        CHECK(map.at(point) == Approx(3 * uv.x() + 2 * uv.y()).epsilon(1e-4));
        CHECK(map.gradient(point).x() == Approx(3).epsilon(1e-3));
        CHECK(map.gradient(point).y() == Approx(2).epsilon(1e-3));
    }
}

// Fails with b on the other side of t.
TEST_CASE("a normal map turns the normal to the right for red and up for green", "[unit]") {
    auto picture = std::make_shared<NormalMap::Pyramid>();
    picture->level.push_back({1, 1, {Eigen::Array3f(.36f, .48f, .8f)}});
    SurfacePoint const point = on_sphere(0);
    Direction const n = NormalMap(picture, {}).normal_at(point);
    CHECK(n.x() == Approx(.8));
    CHECK(n.y() == Approx(.36));  // towards growing u
    CHECK(n.z() == Approx(.48));  // towards growing v
}
