// SPDX-License-Identifier: Apache-2.0
// uv of every shape lies in the unit square, grows as dp_du and dp_dv say, and keeps pictures upright and unmirrored.
#include <catch2/catch.hpp>

#include "support/scenes.h"

using namespace iride;

namespace {

char const* const textured =
    R"("material": { "type": "diffuse", "reflectance": { "checker": [0.2, 0.8], "scale": [7, 5] } })";

std::unique_ptr<Scene> scene_of(std::string const& shape, std::string const& rest = "") {
    return test::scene_from(R"({ "camera": { "eye": [0,0,9], "target": [0,0,0], "field_deg": 20 }, "shapes": [ { )" +
                            shape + ", " + textured + " } ]" + rest + "}");
}

std::optional<Hit> looked_at(Scene const& scene, Vector const& from, Vector const& towards) {
    RayStatistics statistics;
    return scene.accelerator->closest({from, (towards - from).normalized()}, statistics);
}

// Around each of some points: two neighbours on the surface differ by what the derivatives say.
void check_derivatives(Scene const& scene, Vector const& eye) {
    int checked = 0;
    for (float x : {-.31f, -.1f, .07f, .23f})
        for (float y : {-.27f, .05f, .2f}) {
            auto const hit = looked_at(scene, eye, {x, y, 0});
            if (!hit) continue;
            SurfacePoint const& p = hit->point;
            INFO("at " << p.position.transpose() << " uv " << p.uv.transpose());
            CHECK(p.uv.minCoeff() >= 0);
            CHECK(p.uv.maxCoeff() <= 1);
            CHECK(p.tangent.norm() == Approx(1));
            CHECK(p.tangent.dot(p.normal) == Approx(0).margin(1e-5));
            // Upright and not mirrored: u, v and the front normal are right-handed.
            CHECK(p.dp_du.cross(p.dp_dv).dot(p.geometric_normal) > 0);
            for (Vector const& step : {Vector(.01f, 0, 0), Vector(0, .01f, 0)}) {
                auto const near = looked_at(scene, eye, Vector(x, y, 0) + step);
                if (!near || near->shape != hit->shape) continue;
                Vector2 const d = near->point.uv - p.uv;
                if (d.cwiseAbs().maxCoeff() > .5f) continue;  // across the seam
                // Halfway, so that curvature falls out.
                Vector const moved = near->point.position - p.position;
                Vector const told =
                    d.x() * (p.dp_du + near->point.dp_du) / 2 + d.y() * (p.dp_dv + near->point.dp_dv) / 2;
                CHECK((moved - told).norm() < 2e-3f * moved.norm() + 2e-6f);
                ++checked;
            }
        }
    CHECK(checked >= 8);
}

}  // namespace

// Fails for a sphere with the longitude turned round, a quad with its triangles' own coordinates, a frustum without the
// slope of its side.
TEST_CASE("uv grows as its derivatives say, upright and unmirrored", "[law]") {
    for (
        char const* shape :
        {R"("type": "sphere", "centre": [0,0,0], "radius": 0.5)",
         R"("type": "quad", "corners": [[-1,-1,0],[1,-1,0],[1,1,0],[-1,1,0]])",
         R"("type": "quad", "corners": [[-1,-1,0],[1.3,-0.7,0],[0.6,0.8,0],[-0.9,1.2,0]])",
         R"("type": "disc", "centre": [0.1,0,0], "normal": [0.2,0.3,1], "radius": 0.8)",
         R"("type": "cylinder", "from": [0.2,-1,0], "to": [-0.1,1,0.3], "radius": 0.5)",
         R"("type": "cone", "from": [0,-1,0], "to": [0,1,0], "radius": 0.8, "top_radius": 0.2)",
         R"("type": "box", "min": [-1,-1,-1], "max": [1,1,1])",
         R"("type": "mesh", "vertices": [[-1,-1,0.2],[1,-1,0],[0,1.5,0]], "triangles": [[0,1,2]], "uv": [[0,0],[1,0.1],[0.4,1]])"}) {
        INFO(shape);
        check_derivatives(*scene_of(shape), {.3f, .2f, 6});
    }
}

TEST_CASE("an instance stretches derivatives with the surface", "[law]") {
    auto const scene =
        test::scene_from(std::string(R"({ "camera": { "eye": [0,0,9], "target": [0,0,0], "field_deg": 20 },
        "objects": { "o": [ { "type": "sphere", "centre": [0,0,0], "radius": 0.4, )") +
                         textured + R"( } ] },
        "instances": [ { "object": "o", "transform": [ { "scale": [1.4, 0.9, 0.7] }, { "rotate": [1,2,3], "angle_deg": 40 }, { "translate": [0.05, 0, 0] } ] } ] })");
    check_derivatives(*scene, {.3f, .2f, 6});
}

TEST_CASE("known places of known shapes have their uv", "[unit]") {
    auto const uv = [](std::string const& shape, Vector const& from, Vector const& towards) {
        auto const hit = looked_at(*scene_of(shape), from, towards);
        REQUIRE(hit);
        return hit->point.uv;
    };
    std::string const sphere = R"("type": "sphere", "centre": [0,0,0], "radius": 1)";
    CHECK((uv(sphere, {0, 0, 5}, {0, 0, 0}) - Vector2(.5f, .5f)).norm() < 1e-5f);
    CHECK((uv(sphere, {5, 0, 0}, {0, 0, 0}) - Vector2(.75f, .5f)).norm() < 1e-5f);
    CHECK(uv(sphere, {0, 5, 0}, {0, 0, 0}).y() == Approx(1));
    CHECK(uv(sphere, {0, -5, 0}, {0, 0, 0}).y() == Approx(0).margin(1e-5));
    // A crooked quad: where the bilinear map puts (.25, .75).
    CHECK((uv(R"("type": "quad", "corners": [[0,0,0],[4,0,0],[3,2,0],[0,1,0]])", {1, 1, 5},
              {.75f * .25f * 3 + .25f * .25f * 4, .75f * (.25f * 2 + .75f), 0}) -
           Vector2(.25f, .75f))
              .norm() < 1e-5f);
    std::string const box = R"("type": "box", "min": [-1,-1,-1], "max": [1,1,1])";
    for (auto const& from : {Vector(5, .5f, 0), Vector(-5, .5f, 0), Vector(0, .5f, 5), Vector(0, .5f, -5)})
        CHECK((uv(box, from, {from.x() / 5, .5f, from.z() / 5}) - Vector2(.5f, .75f)).norm() < 1e-5f);  // upright
}

// A ray of width w at distance t: w across, w / cosine along, in units of uv.
TEST_CASE("the footprint of a ray is its width across and more along", "[unit]") {
    auto const scene = scene_of(R"("type": "quad", "corners": [[-2,0,2],[2,0,2],[2,0,-2],[-2,0,-2]])");
    Ray const ray{{0, 3, 4}, Vector(0, -3, -4).normalized()};
    Hit hit;
    ClosestQuery query{&ray, &hit, {.width = .02f, .spread = .01f}};
    RayStatistics statistics;
    scene->accelerator->closest({&query, 1}, Accelerator::Coherence::none, statistics);
    REQUIRE(query.found);
    float const width = .02f + .01f * 5;
    CHECK(hit.point.across_ray.norm() == Approx(width / 4));
    CHECK(std::abs(hit.point.across_ray.x()) == Approx(width / 4));
    CHECK(std::abs(hit.point.along_ray.y()) == Approx(width / .6 / 4));
}

TEST_CASE("shapes that nobody asks for uv are not parametrised", "[unit]") {
    auto const scene = test::scene_from(R"({ "camera": { "eye": [0,0,9], "target": [0,0,0], "field_deg": 20 },
        "shapes": [ { "type": "sphere", "centre": [0,0,0], "radius": 1, "material": { "type": "diffuse", "reflectance": 0.5 } } ] })");
    CHECK(!scene->shapes[0].parametrised);
    CHECK(scene_of(R"("type": "sphere", "centre": [0,0,0], "radius": 1)")->shapes[0].parametrised);
}
