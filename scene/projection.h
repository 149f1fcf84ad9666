// SPDX-License-Identifier: Apache-2.0
// Where a camera sees a point, and a direction, of the scene: the inverse of Camera::ray. Lines and planes stay such in
// the perspective and parallel projections, which are matrices on homogeneous coordinates. In right, up and depth
// (x, y, z) about the eye, or about the target for parallel projections, and picture heights:
//   perspective   X = (x - 2 h s_x z) / (2 h z),   Y likewise       h = tan(field / 2), s the shift
//   oblique       X = (x + k cos(a) z) / (2 h),   Y = (y + k sin(a) z) / (2 h)     h the half window; [Carlbom 1978]
// k = 1 is the cavalier projection, k = 1/2 the cabinet one, k = 0 the orthographic one. Parallel lines meet where the
// camera sees their direction, their vanishing point.
#pragma once

#include <optional>

#include "scene/camera.h"

namespace iride {

class PictureProjection {
  public:
    PictureProjection(CameraSettings const& settings, int width, int height);

    struct PicturePoint {
        double x, y;  // pixels from the top left; may lie beyond the picture
    };
    // Nothing: before a perspective camera's eye there is no image of what lies beside or behind it.
    std::optional<PicturePoint> of_point(VectorDouble const& point) const;
    // Where lines along `direction` go to; both its senses count. Nothing: their images are parallel.
    std::optional<PicturePoint> vanishing_point(VectorDouble const& direction) const;

  private:
    std::optional<PicturePoint> of_homogeneous(Eigen::Vector4d const& point) const;
    PicturePoint of_panorama(VectorDouble const& direction) const;

    CameraSettings settings_;
    CameraAxes axes_;
    double width_, height_;
    Eigen::Matrix<double, 3, 4> matrix_;  // (point, 1) -> (x, y, 1) in pixels, up to a factor; not of panoramas
    bool is_panorama_;
};

}  // namespace iride
