// SPDX-License-Identifier: Apache-2.0
// The camera as the light sees it. A pixel measures I = int h(r) L dr dl over picture points r [pixels], with filter h,
// int h = 1, and over the lens, int dl = 1. Seen from a surface point y by lens point l, dr = S dA cos(y), where S is
// how many square pixels the image of a square metre that faces the ray has:
//   perspective    S = 1 / (a cos^3 d^2)   a: area of a pixel at axial distance 1, cos: at the lens against the axis,
//                                          d: from lens to y. A thin lens images by its plane in focus at axial
//                                          distance F: a F^2 there, seen at F / cos; F cancels. So r is that of the
//                                          point in focus on the ray from l to y, and a pinhole is the lens of radius 0
//   orthographic   S = 1 / a               a: area of a pixel of the window
// A light path that reaches y then adds h(r) f L cos(y) S to every pixel around r, and S cos(y) is the density over
// area with which a camera path of evenly spread picture points reaches y.   [Veach 1997, sec. 8.2]
#pragma once

#include <optional>
#include <string>

#include "scene/camera.h"

namespace iride {

struct SightOfCamera {
    Direction towards;  // from the point
    float distance;     // to the lens, or to the window
    float x, y;         // where the picture has the point [pixels]; may lie outside of it
    float density;      // S [pixels^2 / m^2]
};

class CameraImportance {
  public:
    CameraImportance(CameraSettings const& settings, int width, int height);

    // Why light cannot be traced to such a camera; empty: it can.
    static std::string why_unsupported(CameraSettings const& settings);

    // `point` as seen by lens point `lens` of the unit square; absent from behind.
    std::optional<SightOfCamera> sight_of(Vector const& point, Sample2 lens) const;
    // S at `distance` metres along a ray of the camera.
    float density(Ray const& ray, float distance) const;

  private:
    bool perspective_;
    Vector eye_, forward_, right_, up_;  // right_ and up_ of unit length
    float half_width_, half_height_;     // of the picture at distance 1, or of the window
    float picture_width_, picture_height_;
    float per_pixel_area_;  // 1 / a
    float aperture_radius_, focus_distance_;
};

}  // namespace iride
