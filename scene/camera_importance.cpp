// SPDX-License-Identifier: Apache-2.0
#include "scene/camera_importance.h"

#include "base/warp.h"

namespace iride {

std::string CameraImportance::why_unsupported(CameraSettings const& s) {
    using Projection = CameraSettings::Projection;
    if (s.projection != Projection::perspective && s.projection != Projection::orthographic)
        return "light is traced to perspective and orthographic cameras only";
    std::array<double, 2> const none{0, 0};
    if (s.shift != none) return "light is not traced to a shifted picture";
    if (s.focus_tilt_deg != none || s.lens_tilt_deg != none) return "light is not traced through a tilted lens";
    if (s.blades != 0) return "light is not traced through a polygonal aperture";
    return {};
}

CameraImportance::CameraImportance(CameraSettings const& s, int width, int height)
    : perspective_(s.projection == CameraSettings::Projection::perspective),
      picture_width_(static_cast<float>(width)),
      picture_height_(static_cast<float>(height)),
      aperture_radius_(static_cast<float>(s.aperture_radius)),
      focus_distance_(s.aperture_radius > 0 ? static_cast<float>(s.focus_distance) : 1) {
    CameraAxes const axes(s);
    double const half = perspective_ ? std::tan(radians(s.field_deg) / 2) : s.window;
    eye_ = s.eye.cast<float>();
    forward_ = axes.forward.cast<float>();
    right_ = axes.right.cast<float>();
    up_ = axes.up.cast<float>();
    half_height_ = static_cast<float>(half);
    half_width_ = static_cast<float>(half * width / height);
    per_pixel_area_ = static_cast<float>(square(height / (2 * half)));
}

std::optional<SightOfCamera> CameraImportance::sight_of(Vector const& point, Sample2 lens) const {
    Vector2 const l = perspective_ && aperture_radius_ > 0 ? Vector2(aperture_radius_ * to_disc(lens)) : Vector2(0, 0);
    Vector const from = eye_ + right_ * l.x() + up_ * l.y(), d = point - from;
    float const depth = d.dot(forward_);
    if (!(depth > 0)) return std::nullopt;
    Vector2 const across(d.dot(right_), d.dot(up_));
    SightOfCamera sight;
    Vector2 at = across;  // in units of the picture at distance 1, or of the window
    if (perspective_) {
        // On the plane in focus the ray is at l + across / depth F.
        at = across / depth + l / focus_distance_;
        sight.distance = d.norm();
        sight.towards = -d / sight.distance;
        sight.density = density({from, -sight.towards}, sight.distance);
    } else {
        sight.distance = depth;
        sight.towards = -forward_;
        sight.density = per_pixel_area_;
    }
    sight.x = (1 + at.x() / half_width_) * picture_width_ / 2;
    sight.y = (1 - at.y() / half_height_) * picture_height_ / 2;
    return sight;
}

float CameraImportance::density(Ray const& ray, float distance) const {
    if (!perspective_) return per_pixel_area_;
    float const cosine = ray.direction.dot(forward_);
    return per_pixel_area_ / (cosine * cosine * cosine * square(distance));
}

}  // namespace iride
