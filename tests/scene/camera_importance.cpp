// SPDX-License-Identifier: Apache-2.0
// What light sees of a camera is the camera's rays backwards, and the density of their ends.
#include "scene/camera_importance.h"

#include <catch2/catch.hpp>

using namespace iride;

namespace {

CameraSettings settings() {
    CameraSettings s;
    s.eye = {1, 2, 3};
    s.target = {2, 1.5, 7};
    s.field_deg = 60;
    return s;
}
CameraSettings lens() {
    CameraSettings s = settings();
    s.aperture_radius = 0.25;
    s.focus_distance = 4;
    return s;
}
CameraSettings window() {
    CameraSettings s = settings();
    s.projection = CameraSettings::Projection::orthographic;
    s.window = 1.5;
    return s;
}

constexpr int width = 40, height = 20;

// Where the ray meets the plane through `at` that faces `facing`.
Vector on_plane(Ray const& ray, Vector const& at, Direction const& facing) {
    return ray.origin + (at - ray.origin).dot(facing) / ray.direction.dot(facing) * ray.direction;
}

}  // namespace

TEST_CASE("a point on a camera's ray is seen at the ray's place in the picture", "[law]") {
    for (CameraSettings const& s : {settings(), lens(), window()}) {
        Camera const camera(s, width, height);
        CameraImportance const importance(s, width, height);
        for (std::uint32_t i = 0; i < 200; ++i) {
            Sampler sampler(SamplerKind::independent, 41, 0, i);
            Sample2 const place = sampler.next2(), l = sampler.next2();
            float const distance = 0.5f + 6 * sampler.next();
            Ray const ray = camera.ray(width * place.x, height * place.y, l);
            auto const sight = importance.sight_of(ray.origin + distance * ray.direction, l);
            REQUIRE(sight);
            CHECK(sight->x == Approx(width * place.x).margin(2e-4));
            CHECK(sight->y == Approx(height * place.y).margin(2e-4));
            CHECK(sight->distance == Approx(distance).epsilon(1e-4));
            CHECK((sight->towards + ray.direction).norm() < 1e-4f);
            CHECK(sight->density == Approx(importance.density(ray, distance)).epsilon(1e-3));
            CHECK(!importance.sight_of(ray.origin - distance * ray.direction, l));
        }
    }
}

// The Jacobian by differences: S = square pixels per square metre of a surface across the ray.
TEST_CASE("the density of a camera's rays is their Jacobian", "[law]") {
    for (CameraSettings const& s : {settings(), lens(), window()}) {
        Camera const camera(s, width, height);
        CameraImportance const importance(s, width, height);
        for (std::uint32_t i = 0; i < 50; ++i) {
            Sampler sampler(SamplerKind::independent, 42, 0, i);
            Sample2 const place = sampler.next2(), l = sampler.next2();
            float const distance = 0.5f + 6 * sampler.next(), x = width * place.x, y = height * place.y, h = 0.25f;
            Ray const ray = camera.ray(x, y, l);
            Vector const at = ray.origin + distance * ray.direction;
            auto const meet = [&](float dx, float dy) {
                return on_plane(camera.ray(x + dx, y + dy, l), at, ray.direction);
            };
            double const area =
                static_cast<double>(((meet(h, 0) - meet(-h, 0)).cross(meet(0, h) - meet(0, -h))).norm() / (4 * h * h));
            CHECK(importance.density(ray, distance) == Approx(1 / area).epsilon(5e-3));
        }
    }
}
