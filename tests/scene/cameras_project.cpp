// SPDX-License-Identifier: Apache-2.0
// What is seen where: rays through the image of a point meet the point, lenses are sharp and blurred where optics says,
// panoramas give each direction its share, and parallel lines meet in their vanishing point.
#include "scene/projection.h"

#include <catch2/catch.hpp>

using namespace iride;
using Projection = CameraSettings::Projection;

namespace {

constexpr int width = 48, height = 32;

CameraSettings slanted(Projection projection) {
    CameraSettings s;
    s.projection = projection;
    s.eye = {1, 2, -3};
    s.target = {.5, 1, 2};
    s.field_deg = 50;
    s.window = 2;
    return s;
}

double distance_to_line(VectorDouble const& p, Ray const& ray) {
    return (p - ray.origin.cast<double>()).cross(ray.direction.cast<double>()).norm();
}

CameraSettings shifted() {
    CameraSettings s = slanted(Projection::perspective);
    s.shift = {.3, -.7};
    return s;
}
CameraSettings cabinet() {
    CameraSettings s = slanted(Projection::oblique);
    s.receding_angle_deg = 30;
    return s;
}
std::vector<CameraSettings> all_cameras() {
    std::vector<CameraSettings> all{shifted(), cabinet()};
    for (auto p : {Projection::perspective, Projection::orthographic, Projection::equirectangular,
                   Projection::cylindrical, Projection::fisheye_equidistant, Projection::fisheye_equisolid})
        all.push_back(slanted(p));
    return all;
}

// In right, up, depth.
VectorDouble in_axes(CameraSettings const& s, VectorDouble const& v) {
    CameraAxes const axes(s);
    return {v.dot(axes.right), v.dot(axes.up), v.dot(axes.forward)};
}
VectorDouble from_axes(CameraSettings const& s, VectorDouble const& v) {
    CameraAxes const axes(s);
    return v.x() * axes.right + v.y() * axes.up + v.z() * axes.forward;
}

}  // namespace

// Fails for a shift of the wrong sign, and for receding lines that run the other way.
TEST_CASE("the ray through the image of a point meets the point", "[law]") {
    for (CameraSettings const& s : all_cameras()) {
        Camera const camera(s, width, height);
        PictureProjection const projection(s, width, height);
        Sampler sampler(SamplerKind::independent, 2, 0, 0);
        for (int i = 0; i < 100; ++i) {
            Sample2 const u = sampler.next2();
            VectorDouble const place(4 * u.x - 2, 4 * u.y - 2, 1 + 4 * sampler.next());
            VectorDouble const p = s.eye + from_axes(s, place);
            auto const seen = projection.of_point(p);
            REQUIRE(seen);
            Ray const ray = camera.ray(static_cast<float>(seen->x), static_cast<float>(seen->y), {.2f, .3f});
            INFO("projection " << static_cast<int>(s.projection));
            CHECK(distance_to_line(p, ray) < 2e-5);
            if (s.projection != Projection::oblique)
                CHECK((p - ray.origin.cast<double>()).dot(ray.direction.cast<double>()) > 0);
        }
    }
}
TEST_CASE("what is behind a perspective camera has no image", "[unit]") {
    CameraSettings const s = slanted(Projection::perspective);
    CHECK_FALSE(PictureProjection(s, width, height).of_point(s.eye + from_axes(s, {0, 0, -1})));
}

// A unit cube whose front face lies in the target's plane: the face in true shape; an edge in depth is drawn k long at
// the angle a. Cavalier: k = 1, cabinet: k = 1/2.
TEST_CASE("an oblique projection draws the front in true size and depth at its scale and angle", "[unit]") {
    for (double const k : {1., .5, 0.})
        for (double const a : {45., 30., 135.}) {
            CameraSettings s = slanted(Projection::oblique);
            s.receding_scale = k;
            s.receding_angle_deg = a;
            PictureProjection const projection(s, width, height);
            double const pixels = height / (2 * s.window);  // per metre
            auto const seen = [&](double x, double y, double z) {
                auto const p = *projection.of_point(s.target + from_axes(s, {x, y, z}));
                return Eigen::Vector2d((p.x - width / 2.) / pixels, (height / 2. - p.y) / pixels);
            };
            CHECK((seen(0, 0, 0)).norm() < 1e-12);
            CHECK((seen(1, 0, 0) - Eigen::Vector2d(1, 0)).norm() < 1e-12);
            CHECK((seen(0, 1, 0) - Eigen::Vector2d(0, 1)).norm() < 1e-12);
            Eigen::Vector2d const depth = k * Eigen::Vector2d(std::cos(radians(a)), std::sin(radians(a)));
            CHECK((seen(0, 0, 1) - depth).norm() < 1e-12);
            CHECK((seen(1, 1, 1) - Eigen::Vector2d(1, 1) - depth).norm() < 1e-12);
        }
}

// Solid angle of a pixel: the rays' cross product by differences. Equirectangular: cos(latitude) (2 pi / w) (pi / h);
// cylindrical: cos^3(elevation) times the square at the horizon; fisheyes: a sin(t) / t of it, or the same everywhere,
// 4 pi sin^2(half / 2) over the disc of height h.
TEST_CASE("pixels of panoramas have their solid angles", "[law]") {
    for (CameraSettings s : all_cameras()) {
        if (s.projection <= Projection::oblique) continue;
        s.field_deg = s.projection == Projection::cylindrical ? 300 : 170;
        Camera const camera(s, width, height);
        double const half = radians(s.field_deg) / 2;
        for (float const x : {5.f, 17.f, 24.5f, 30.f})
            for (float const y : {8.f, 15.5f, 25.f}) {
                constexpr float step = .25f;
                auto const along = [&](float dx, float dy) {
                    return VectorDouble(
                        (camera.ray(x + dx, y + dy, {}).direction - camera.ray(x - dx, y - dy, {}).direction)
                            .cast<double>() /
                        (2 * static_cast<double>(step)));
                };
                double const measured = along(step, 0).cross(along(0, step)).norm();
                VectorDouble const d = in_axes(s, camera.ray(x, y, {}).direction.cast<double>());
                double const angle = std::acos(d.z()), level = std::hypot(d.x(), d.z());
                double wanted = 0;
                if (s.projection == Projection::equirectangular)
                    wanted = level * 2 * square(pi_double) / width / height;
                else if (s.projection == Projection::cylindrical)
                    wanted = level * level * level * square(2 * half / width);
                else if (s.projection == Projection::fisheye_equidistant)
                    wanted = std::sin(angle) / angle * square(2 * half / height);
                else
                    wanted = 4 * square(std::sin(half / 2)) / square(height / 2.);
                INFO("projection " << static_cast<int>(s.projection) << " at " << x << ", " << y);
                CHECK(measured == Approx(wanted).epsilon(2e-3));  // of the differences: (step angle)^2 / 6
            }
    }
}

TEST_CASE("images of far points go to the vanishing point", "[law]") {
    for (CameraSettings const& s : {slanted(Projection::perspective), shifted(), slanted(Projection::equirectangular),
                                    slanted(Projection::cylindrical), slanted(Projection::fisheye_equisolid)}) {
        PictureProjection const projection(s, width, height);
        for (VectorDouble const& d : {VectorDouble(1, 0, 1), VectorDouble(0, .3, 1), VectorDouble(-.2, -.1, 2)}) {
            auto const there = projection.vanishing_point(d);
            auto const far = projection.of_point(s.eye + VectorDouble(3, -2, 1) + 1e9 * d);
            REQUIRE(there);
            REQUIRE(far);
            CHECK(there->x == Approx(far->x).margin(1e-5).epsilon(0));
            CHECK(there->y == Approx(far->y).margin(1e-5).epsilon(0));
        }
    }
}
TEST_CASE("lines across the axis, and all lines under parallel projection, stay parallel", "[unit]") {
    CameraSettings const s = shifted();
    CHECK_FALSE(PictureProjection(s, width, height).vanishing_point(CameraAxes(s).right));
    CHECK_FALSE(PictureProjection(s, width, height).vanishing_point(from_axes(s, {.3, -2, 0})));
    for (CameraSettings const& p : {cabinet(), slanted(Projection::orthographic)})
        CHECK_FALSE(PictureProjection(p, width, height).vanishing_point({1, 2, 3}));
}

namespace {

CameraSettings with_lens(double tilt_x, double tilt_y) {
    CameraSettings s = slanted(Projection::perspective);
    s.focal_length = .09;
    s.field_deg = 2 * std::atan(.06 / (2 * s.focal_length)) / radians(1);
    s.aperture_radius = s.focal_length / (2 * 2.8);
    s.focus_distance = 1.7;
    s.lens_tilt_deg = {tilt_x, tilt_y};
    return s;
}

// Where the rays of a picture point through two places of the lens meet.
VectorDouble meeting(Camera const& camera, float x, float y) {
    Ray const a = camera.ray(x, y, {.1f, .2f}), b = camera.ray(x, y, {.9f, .6f});
    VectorDouble const p = a.origin.cast<double>(), q = b.origin.cast<double>(), u = a.direction.cast<double>(),
                       v = b.direction.cast<double>();
    VectorDouble const across = u.cross(v);
    return p + (q - p).cross(v).dot(across) / across.squaredNorm() * u;
}

}  // namespace

// By the thin lens alone: a point Q at the distance z = Q . a along the axis a of a lens of focal length f has its
// image at -Q f / (z - f). Whatever is sharp must have it in one plane across the camera's own axis: the sensor, at the
// distance f d / (d a.F - f). Fails for a plane in focus parallel to the lens.
TEST_CASE("a tilted lens is sharp where the sensor's plane has its image", "[law]") {
    for (auto const& [tilt_x, tilt_y] : {std::pair(0., 0.), {6., 0.}, {0., -4.}, {-3., 5.}}) {
        CameraSettings const s = with_lens(tilt_x, tilt_y);
        Camera const camera(s, width, height);
        CameraAxes const axes(s);
        VectorDouble const a = axes.tilted(s.lens_tilt_deg);
        double const sensor =
            s.focal_length * s.focus_distance / (s.focus_distance * a.dot(axes.forward) - s.focal_length);
        for (float const x : {2.f, 24.f, 45.f})
            for (float const y : {3.f, 16.f, 30.f}) {
                VectorDouble const Q = meeting(camera, x, y) - s.eye;
                VectorDouble const image = -s.focal_length / (Q.dot(a) - s.focal_length) * Q;
                INFO("tilts " << tilt_x << ", " << tilt_y << " at " << x << ", " << y);
                CHECK(-image.dot(axes.forward) == Approx(sensor).epsilon(2e-4));
            }
    }
}

// Of a point on the plane all rays meet at it; that plane leans by the tilt.
TEST_CASE("a tilted plane in focus is sharp all over", "[law]") {
    CameraSettings s = with_lens(0, 0);
    s.focus_tilt_deg = {70, -20};
    Camera const camera(s, width, height);
    CameraAxes const axes(s);
    VectorDouble const on_axis = s.eye + s.focus_distance * axes.forward, normal = axes.tilted(s.focus_tilt_deg);
    CHECK(std::acos(normal.dot(axes.forward)) ==
          Approx(std::acos(std::cos(radians(70.)) * std::cos(radians(20.)))).epsilon(1e-12));
    CHECK(normal.dot(axes.up) > 0);
    CHECK(normal.dot(axes.right) < 0);
    for (float const x : {2.f, 24.f, 45.f})
        for (float const y : {3.f, 16.f, 18.f}) {
            VectorDouble const p = meeting(camera, x, y);
            CHECK((p - on_axis).dot(normal) == Approx(0).margin(5e-4 * (p - s.eye).norm()));
        }
}

// A point at z is seen through all of the lens in a circle of diameter A |z - d| / z on the plane in focus, as large in
// the picture as that is there: over 2 d tan(field / 2) picture heights.
TEST_CASE("a point out of focus is a circle of confusion", "[law]") {
    CameraSettings const s = with_lens(0, 0);
    Camera const camera(s, width, height);
    PictureProjection const projection(s, width, height);
    CameraAxes const axes(s);
    for (double const z : {.6, 1.2, 1.7, 5., 1e3}) {
        VectorDouble const p = s.eye + from_axes(s, {.05, -.02, z});
        double const diameter = s.focal_length / 2.8 * std::abs(z - s.focus_distance) / z /
                                (2 * s.focus_distance * std::tan(radians(s.field_deg) / 2)) * height;
        for (Sample2 const edge : {Sample2{0, .5f}, {.5f, 0}, {.99999f, .2f}}) {
            // Where a ray through this place of the lens crosses the plane of p is affine in the picture point.
            auto const crossing = [&](float x, float y) {
                Ray const ray = camera.ray(x, y, edge);
                VectorDouble const o = ray.origin.cast<double>(), d = ray.direction.cast<double>();
                VectorDouble const there = o + (p - o).dot(axes.forward) / d.dot(axes.forward) * d - p;
                return Eigen::Vector2d(there.dot(axes.right), there.dot(axes.up));
            };
            Eigen::Vector2d const at0 = crossing(0, 0);
            Eigen::Matrix2d per_pixel;
            per_pixel << (crossing(width, 0) - at0) / width, (crossing(0, height) - at0) / height;
            Eigen::Vector2d const place = per_pixel.inverse() * -at0;
            auto const centre = *projection.of_point(p);
            CHECK(2 * (place - Eigen::Vector2d(centre.x, centre.y)).norm() ==
                  Approx(diameter).margin(3e-4).epsilon(1e-4));
        }
    }
}

// Uniform on a regular polygon of n corners on the circle R: mean square distance from its centre
// R^2 (2 + cos(2 pi / n)) / 6, and no place beyond the sides at R cos(pi / n).
TEST_CASE("an aperture of blades is an evenly filled polygon", "[law]") {
    for (int const n : {3, 5, 8}) {
        CameraSettings s = with_lens(0, 0);
        s.blades = n;
        s.blade_rotation_deg = 10;
        Camera const camera(s, width, height);
        constexpr std::uint32_t samples = 4096;
        double mean_square = 0;
        VectorDouble mean(0, 0, 0);
        for (std::uint32_t i = 0; i < samples; ++i) {
            Ray const ray = camera.ray(20, 10, Sampler(SamplerKind::sobol, 3, 0, i).next2());
            VectorDouble const p = in_axes(s, ray.origin.cast<double>() - s.eye) / s.aperture_radius;
            mean_square += p.squaredNorm() / samples;
            mean += p / samples;
            for (int side = 0; side < n; ++side) {
                // Corners at 10 degrees anticlockwise from the top, and on.
                double const a = radians(10 + 360. / n * (side + .5));
                CHECK(-std::sin(a) * p.x() + std::cos(a) * p.y() < std::cos(pi_double / n) + 1e-4);
            }
        }
        CHECK(mean_square == Approx((2 + std::cos(2 * pi_double / n)) / 6).epsilon(4e-3));
        CHECK(mean.norm() < 4e-3);
    }
}
