// SPDX-License-Identifier: Apache-2.0
// Cameras turn a point of the picture and a point of the lens into a ray. Picture coordinates are pixels from the top
// left; x runs to the viewer's right. Where points of the scene are seen: scene/projection.h.
#pragma once

#include <array>

#include "base/sampler.h"
#include "base/vector.h"
#include "scene/ray_cone.h"

namespace iride {

struct CameraSettings {
    // Oblique: parallel rays, slanted against the picture. Panoramas: equirectangular is all of the sphere, cylindrical
    // a band around the up direction, fisheyes map the angle t from the axis to a radius of t or of 2 sin(t / 2).
    enum class Projection {
        perspective,
        orthographic,
        oblique,
        equirectangular,
        cylindrical,
        fisheye_equidistant,
        fisheye_equisolid
    };
    Projection projection = Projection::perspective;
    VectorDouble eye{0, 0, 0}, target{0, 0, 1}, up{0, 1, 0};  // metres
    // Perspective: full vertical field; cylindrical: around; fisheyes: across the picture's height.
    double field_deg = 40;
    double window = 1;                               // orthographic, oblique: half height [m]
    double aperture_radius = 0, focus_distance = 0;  // thin lens [m]
    int blades = 0;                                  // of a polygonal aperture, 0: round
    double blade_rotation_deg = 0;      // anticlockwise, as the lens is seen from behind; 0: a corner is up
    std::array<double, 2> shift{0, 0};  // perspective: of the picture to the right and up, in its heights
    // Tilts turn a plane about the picture's x axis (its upper part comes nearer), then about its own y axis (its right
    // part comes nearer): the plane in focus, or the lens, whose focal length then says where it is sharp.
    std::array<double, 2> focus_tilt_deg{0, 0}, lens_tilt_deg{0, 0};
    double focal_length = 0, f_number = 0;                 // [m], -; 0: not stated
    double receding_scale = 0.5, receding_angle_deg = 45;  // oblique: how depth is drawn, and where it runs to
};

// Right, up and forward of a camera, orthonormal.
struct CameraAxes {
    VectorDouble right, up, forward;
    explicit CameraAxes(CameraSettings const& settings);
    // The normal, on the side of `forward`, of a plane across it that is turned by two tilts.
    VectorDouble tilted(std::array<double, 2> const& tilt_deg) const;
    // A vector n with n . (p - eye) = 1 where p is sharp. Of a tilted lens of normal a and focal length f, F being
    // forward and d the distance: n ~ d a - (d a.F - f) F, the plane that meets those of lens and sensor in one line.
    VectorDouble plane_in_focus(CameraSettings const& settings) const;
};

class Camera {
  public:
    Camera(CameraSettings const& settings, int width, int height);

    // The ray through picture point (x, y), from lens point `lens` of the unit square (unused by a pinhole).
    Ray ray(float x, float y, Sample2 lens) const;

    // What a pixel in the middle of the picture sees; the lens is left out.
    RayCone pixel_cone() const;

  private:
    Ray panoramic_ray(float x, float y) const;
    Vector2 point_of_lens(Sample2 u) const;

    CameraSettings::Projection projection_;
    Vector eye_, forward_, right_, up_;  // right_ and up_ scaled to half a picture at distance 1 (or to the window)
    Vector centre_;                      // through the middle of the picture, at axial distance 1
    float scale_x_, scale_y_;            // pixels -> [-1, 1]
    float aperture_radius_, focus_distance_;
    Vector lens_x_, lens_y_;  // unit vectors of its plane
    Vector in_focus_;         // in_focus_ . (p - eye) = 1 where p is sharp
    int blades_;
    float blade_rotation_;     // turns
    float angle_x_, angle_y_;  // panoramas: the field's half, by width and by height [rad]
};

}  // namespace iride
