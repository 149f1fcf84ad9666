// SPDX-License-Identifier: Apache-2.0
#include "scene/projection.h"

namespace iride {

using Projection = CameraSettings::Projection;

namespace {

// (right, up, depth, 1) -> picture heights from the middle, to the right and up, up to a factor.
Eigen::Matrix<double, 3, 4> in_heights(CameraSettings const& s) {
    Eigen::Matrix<double, 3, 4> m = Eigen::Matrix<double, 3, 4>::Zero();
    m(0, 0) = m(1, 1) = 1;
    if (s.projection == Projection::perspective) {
        double const h = std::tan(radians(s.field_deg) / 2);
        m(0, 2) = -2 * h * s.shift[0];
        m(1, 2) = -2 * h * s.shift[1];
        m(2, 2) = 2 * h;
        return m;
    }
    if (s.projection == Projection::oblique) {
        double const a = radians(s.receding_angle_deg);
        m(0, 2) = s.receding_scale * std::cos(a);
        m(1, 2) = s.receding_scale * std::sin(a);
    }
    m(2, 3) = 2 * s.window;
    return m;
}

}  // namespace

PictureProjection::PictureProjection(CameraSettings const& s, int width, int height)
    : settings_(s), axes_(s), width_(width), height_(height), is_panorama_(s.projection > Projection::oblique) {
    if (is_panorama_) return;
    Eigen::Matrix4d to_camera = Eigen::Matrix4d::Identity();
    VectorDouble const origin = s.projection == Projection::perspective ? s.eye : s.target;
    to_camera.topLeftCorner<3, 3>() << axes_.right.transpose(), axes_.up.transpose(), axes_.forward.transpose();
    to_camera.topRightCorner<3, 1>() = -to_camera.topLeftCorner<3, 3>() * origin;
    MatrixDouble to_pixels;
    to_pixels << height_, 0, width_ / 2,  //
        0, -height_, height_ / 2,         //
        0, 0, 1;
    matrix_ = to_pixels * in_heights(s) * to_camera;
}

std::optional<PictureProjection::PicturePoint> PictureProjection::of_homogeneous(Eigen::Vector4d const& point) const {
    VectorDouble const p = matrix_ * point;
    constexpr double parallel = 1e-12;  // to the picture: of the unit direction's part along the axis, rounding
    if (!(std::abs(p.z()) > parallel)) return std::nullopt;
    return PicturePoint{p.x() / p.z(), p.y() / p.z()};
}

std::optional<PictureProjection::PicturePoint> PictureProjection::of_point(VectorDouble const& point) const {
    VectorDouble const from_eye = point - settings_.eye;
    if (is_panorama_) return of_panorama(from_eye);
    if (settings_.projection == Projection::perspective && !(from_eye.dot(axes_.forward) > 0)) return std::nullopt;
    return of_homogeneous(point.homogeneous());
}

std::optional<PictureProjection::PicturePoint> PictureProjection::vanishing_point(VectorDouble const& direction) const {
    VectorDouble const unit = direction.normalized();
    if (is_panorama_) return of_panorama(unit);
    return of_homogeneous({unit.x(), unit.y(), unit.z(), 0});
}

PictureProjection::PicturePoint PictureProjection::of_panorama(VectorDouble const& direction) const {
    double const x = direction.dot(axes_.right), y = direction.dot(axes_.up), z = direction.dot(axes_.forward);
    double const half_field = radians(settings_.field_deg) / 2, level = std::hypot(x, z);
    auto const at = [&](double right, double upwards) {  // -1 .. 1 in the picture
        return PicturePoint{width_ / 2 * (1 + right), height_ / 2 * (1 - upwards)};
    };
    if (settings_.projection == Projection::equirectangular)
        return at(std::atan2(x, z) / pi_double, std::atan2(y, level) / (pi_double / 2));
    if (settings_.projection == Projection::cylindrical)
        return at(std::atan2(x, z) / half_field, y / level / (half_field * height_ / width_));
    double const angle = std::atan2(std::hypot(x, y), z);
    double const r = settings_.projection == Projection::fisheye_equidistant
                         ? angle / half_field
                         : std::sin(angle / 2) / std::sin(half_field / 2);
    double const sideways = std::hypot(x, y);
    if (sideways == 0) return at(0, 0);
    return at(r * x / sideways * height_ / width_, r * y / sideways);
}

}  // namespace iride
