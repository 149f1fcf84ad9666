// SPDX-License-Identifier: Apache-2.0
// Rays of the cameras, against the geometry of the picture: a point at axial distance z and height y above the axis is
// seen y / (z tan(field / 2)) half pictures above the centre.
#include "scene/camera.h"

#include <catch2/catch.hpp>

using namespace iride;

namespace {

// Looks along +z from (1, 2, 3), up is +y: the viewer's right is -x. 40 by 20 pixels, 60 degrees high.
CameraSettings settings() {
    CameraSettings s;
    s.eye = {1, 2, 3};
    s.target = {1, 2, 7};
    s.field_deg = 60;
    return s;
}

// Where the ray meets the plane at axial distance z from the eye, relative to the axis.
VectorDouble at_depth(Ray const& ray, double z) {
    VectorDouble const from = ray.origin.cast<double>() - VectorDouble(1, 2, 3), d = ray.direction.cast<double>();
    return from + (z - from.z()) / d.z() * d;
}

void check_point(VectorDouble const& seen, double x, double y) {
    CHECK(seen.x() == Approx(x).margin(1e-5).epsilon(0));
    CHECK(seen.y() == Approx(y).margin(1e-5).epsilon(0));
}

}  // namespace

// Fails for the field as half of the picture, and for a picture upside down.
TEST_CASE("a pinhole sees half the field above the axis and the picture's shape beside it", "[unit]") {
    Camera const camera(settings(), 40, 20);
    double const half = std::tan(radians(30.));
    auto const seen = [&](float x, float y) { return at_depth(camera.ray(x, y, {.3f, .9f}), 1); };
    check_point(seen(20, 10), 0, 0);
    check_point(seen(20, 0), 0, half);
    check_point(seen(20, 20), 0, -half);
    check_point(seen(40, 10), -2 * half, 0);
    check_point(seen(10, 15), half, -half / 2);
    CHECK(camera.ray(40, 0, {.3f, .9f}).direction.norm() == Approx(1).epsilon(1e-6));
}

// Fails for a picture upside down.
TEST_CASE("an orthographic camera sees its window along parallel rays", "[unit]") {
    CameraSettings s = settings();
    s.projection = CameraSettings::Projection::orthographic;
    s.window = 0.5;
    Camera const camera(s, 40, 20);
    auto const seen = [&](float x, float y, double z) { return at_depth(camera.ray(x, y, {.3f, .9f}), z); };
    for (double z : {0., 9.}) {
        check_point(seen(20, 10, z), 0, 0);
        check_point(seen(20, 0, z), 0, 0.5);
        check_point(seen(0, 20, z), 1, -0.5);
    }
}

// The rays of a picture point through all of the lens meet in the plane in focus, where the pinhole's goes, and fill
// the aperture evenly: the mean square of its radius is half of the whole's. One point lies in each of 64 x 64 cells,
// in which r^2 changes by 4 / 64 at most: standard error 4 / 64 / sqrt(12) / 64. Fails for a focus at a distance along
// the ray, not the axis, and for an aperture of twice the radius.
TEST_CASE("a thin lens is sharp in the plane in focus and evenly filled", "[law]") {
    CameraSettings s = settings();
    Camera const pinhole(s, 40, 20);
    s.aperture_radius = 0.25;
    s.focus_distance = 4;
    Camera const lens(s, 40, 20);
    constexpr std::uint32_t samples = 4096;
    double square_radius = 0, largest = 0;
    for (std::uint32_t i = 0; i < samples; ++i) {
        Ray const ray = lens.ray(33, 4, Sampler(SamplerKind::sobol, 9, 0, i).next2());
        VectorDouble const sharp = at_depth(pinhole.ray(33, 4, {}), 4);
        check_point(at_depth(ray, 4), sharp.x(), sharp.y());
        double const r = at_depth(ray, 0).norm();
        square_radius += r * r / samples;
        largest = std::max(largest, r);
    }
    CHECK(largest <= 0.25 + 1e-6);
    CHECK(square_radius / square(0.25) == Approx(0.5).margin(5 * 4 / 64.0 / std::sqrt(12.0) / 64).epsilon(0));
}
