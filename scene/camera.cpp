// SPDX-License-Identifier: Apache-2.0
#include "scene/camera.h"

#include "base/warp.h"

namespace iride {

Camera::Camera(CameraSettings const& s, int width, int height)
    : projection_(s.projection),
      scale_x_(2 / static_cast<float>(width)),
      scale_y_(2 / static_cast<float>(height)),
      aperture_radius_(static_cast<float>(s.aperture_radius)),
      focus_distance_(static_cast<float>(s.focus_distance)) {
    VectorDouble const forward = (s.target - s.eye).normalized();
    VectorDouble const right = forward.cross(s.up).normalized();
    VectorDouble const up = right.cross(forward);
    bool const perspective = projection_ == CameraSettings::Projection::perspective;
    double const half_height = perspective ? std::tan(radians(s.field_deg) / 2) : s.window;
    eye_ = s.eye.cast<float>();
    forward_ = forward.cast<float>();
    right_ = (right * (half_height * width / height)).cast<float>();
    up_ = (up * half_height).cast<float>();
}

RayCone Camera::pixel_cone() const {
    float const height = up_.norm() * scale_y_;  // of a pixel at distance 1, or of the window
    if (projection_ == CameraSettings::Projection::orthographic) return {.width = height};
    return {.spread = height};
}

Ray Camera::ray(float x, float y, Sample2 lens) const {
    Vector const offset = right_ * (x * scale_x_ - 1) + up_ * (1 - y * scale_y_);
    if (projection_ == CameraSettings::Projection::orthographic) return {eye_ + offset, forward_};
    Vector const through = forward_ + offset;  // at axial distance 1
    if (aperture_radius_ == 0) return {eye_, through.normalized()};
    // Thin lens: every ray of a picture point meets where the central one crosses the plane in focus.
    Vector2 const d = aperture_radius_ * to_disc(lens);
    Vector const origin = eye_ + right_.normalized() * d.x() + up_.normalized() * d.y();
    return {origin, (eye_ + through * focus_distance_ - origin).normalized()};
}

}  // namespace iride
