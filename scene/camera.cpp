// SPDX-License-Identifier: Apache-2.0
#include "scene/camera.h"

#include "base/warp.h"

namespace iride {

using Projection = CameraSettings::Projection;

CameraAxes::CameraAxes(CameraSettings const& s) : forward((s.target - s.eye).normalized()) {
    right = forward.cross(s.up).normalized();
    up = right.cross(forward);
}

VectorDouble CameraAxes::tilted(std::array<double, 2> const& tilt_deg) const {
    // The plane of points p with p . n constant: where n leans up, the upper part comes nearer.
    double const a = radians(tilt_deg[0]), b = radians(tilt_deg[1]);
    return std::cos(b) * (std::cos(a) * forward + std::sin(a) * up) + std::sin(b) * right;
}

VectorDouble CameraAxes::plane_in_focus(CameraSettings const& s) const {
    VectorDouble const lens = tilted(s.lens_tilt_deg);
    double const d = s.focus_distance;
    VectorDouble const n = lens == forward
                               ? tilted(s.focus_tilt_deg)
                               : VectorDouble(d * lens - (d * lens.dot(forward) - s.focal_length) * forward);
    return n / (n.dot(forward) * d);
}

namespace {

double half_height_of(CameraSettings const& s) {
    switch (s.projection) {
        case Projection::perspective:
            return std::tan(radians(s.field_deg) / 2);
        case Projection::orthographic:
        case Projection::oblique:
            return s.window;
        default:
            return 1;
    }
}

// Out of the middle of the picture, at axial distance 1.
VectorDouble centre_of(CameraSettings const& s, CameraAxes const& axes, double half_height) {
    if (s.projection == Projection::oblique) {
        double const a = radians(s.receding_angle_deg);
        return axes.forward - s.receding_scale * (std::cos(a) * axes.right + std::sin(a) * axes.up);
    }
    return axes.forward + 2 * half_height * (s.shift[0] * axes.right + s.shift[1] * axes.up);
}

}  // namespace

Camera::Camera(CameraSettings const& s, int width, int height)
    : projection_(s.projection),
      scale_x_(2 / static_cast<float>(width)),
      scale_y_(2 / static_cast<float>(height)),
      aperture_radius_(static_cast<float>(s.aperture_radius)),
      focus_distance_(static_cast<float>(s.focus_distance)),
      blades_(s.blades),
      blade_rotation_(static_cast<float>(s.blade_rotation_deg / 360)) {
    CameraAxes const axes(s);
    double const half_height = half_height_of(s), aspect = static_cast<double>(width) / height;
    VectorDouble const centre = centre_of(s, axes, half_height);
    VectorDouble eye = s.eye;
    // Drawn in its place and true size is the plane of the target, not that of the eye.
    if (projection_ == Projection::oblique) eye = s.target - (s.target - s.eye).norm() * centre;
    eye_ = eye.cast<float>();
    forward_ = axes.forward.cast<float>();
    centre_ = centre.cast<float>();
    right_ = (axes.right * (half_height * aspect)).cast<float>();
    up_ = (axes.up * half_height).cast<float>();

    VectorDouble const lens = axes.tilted(s.lens_tilt_deg);
    VectorDouble const lens_x = (axes.right - axes.right.dot(lens) * lens).normalized();
    lens_x_ = lens_x.cast<float>();
    lens_y_ = lens_x.cross(lens).cast<float>();
    if (aperture_radius_ > 0) in_focus_ = axes.plane_in_focus(s).cast<float>();

    double const half_field = radians(s.field_deg) / 2;
    if (projection_ == Projection::equirectangular) {
        angle_x_ = pi, angle_y_ = pi / 2;
    } else if (projection_ == Projection::cylindrical) {
        angle_x_ = static_cast<float>(half_field), angle_y_ = static_cast<float>(half_field / aspect);
    } else {
        angle_x_ = static_cast<float>(half_field * aspect), angle_y_ = static_cast<float>(half_field);
    }
}

RayCone Camera::pixel_cone() const {
    float const height = up_.norm() * scale_y_;  // of a pixel at distance 1, or of the window
    switch (projection_) {
        case Projection::perspective:
            return {.spread = height};
        case Projection::orthographic:
        case Projection::oblique:
            return {.width = height};
        default:
            return {.spread = angle_y_ * scale_y_};
    }
}

// On the disc of radius 1, or on the regular polygon in it.
Vector2 Camera::point_of_lens(Sample2 u) const {
    if (blades_ == 0) return to_disc(u);
    // A triangle of the polygon's centre and one side, of equal areas: u.x tells which, and the rest of it the place.
    auto const count = static_cast<float>(blades_);
    float const side = std::min(std::floor(u.x * count), count - 1);
    Vector2 const place = to_triangle({u.x * count - side, u.y});
    auto const corner = [&](float number) {
        auto const [s, c] = sine_cosine_of_turns(number / count + blade_rotation_);
        return Vector2(-s, c);
    };
    return place.x() * corner(side) + place.y() * corner(side + 1);
}

Ray Camera::panoramic_ray(float x, float y) const {
    float const to_right = (x * scale_x_ - 1) * angle_x_, upwards = (1 - y * scale_y_) * angle_y_;
    Direction const right = right_.normalized(), up = up_.normalized();
    if (projection_ == Projection::equirectangular || projection_ == Projection::cylindrical) {
        Vector const level = std::sin(to_right) * right + std::cos(to_right) * forward_;
        if (projection_ == Projection::cylindrical) return {eye_, (level + upwards * up).normalized()};
        return {eye_, (std::cos(upwards) * level + std::sin(upwards) * up).normalized()};
    }
    float const r = std::hypot(to_right, upwards);
    if (r == 0) return {eye_, forward_};
    // r is the angle from the axis, or that of equal solid angle: sin(angle / 2) = r sin(half) / (2 half), half the
    // angle at the edge. What would lie beyond 180 degrees is straight behind.
    float angle = std::min(r, pi);
    if (projection_ == Projection::fisheye_equisolid)
        angle = 2 * std::asin(std::min(1.0f, r / angle_y_ * std::sin(angle_y_ / 2)));
    Vector const sideways = (to_right * right + upwards * up) / r;
    return {eye_, (std::sin(angle) * sideways + std::cos(angle) * forward_).normalized()};
}

Ray Camera::ray(float x, float y, Sample2 lens) const {
    if (projection_ > Projection::oblique) return panoramic_ray(x, y);
    Vector const offset = right_ * (x * scale_x_ - 1) + up_ * (1 - y * scale_y_);
    if (projection_ != Projection::perspective) return {eye_ + offset, centre_.normalized()};
    Vector const through = centre_ + offset;  // at axial distance 1
    if (aperture_radius_ == 0) return {eye_, through.normalized()};
    // Thin lens: every ray of a picture point meets where the central one crosses the plane in focus, at
    // through / (in_focus . through), which may be infinitely far or, beyond the plane's horizon, behind the lens.
    Vector2 const d = aperture_radius_ * point_of_lens(lens);
    Vector const from_centre = lens_x_ * d.x() + lens_y_ * d.y();
    return {eye_ + from_centre, (through - from_centre * in_focus_.dot(through)).normalized()};
}

}  // namespace iride
