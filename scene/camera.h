// SPDX-License-Identifier: Apache-2.0
// Cameras turn a point of the picture and a point of the lens into a ray. Picture coordinates are pixels from the top
// left; x runs to the viewer's right.
#pragma once

#include "base/sampler.h"
#include "base/vector.h"
#include "scene/ray_cone.h"

namespace iride {

struct CameraSettings {
    enum class Projection { perspective, orthographic };
    Projection projection = Projection::perspective;
    VectorDouble eye{0, 0, 0}, target{0, 0, 1}, up{0, 1, 0};  // metres
    double field_deg = 40;                                    // perspective: full vertical field
    double window = 1;                                        // orthographic: half height [m]
    double aperture_radius = 0, focus_distance = 0;           // thin lens [m]
};

class Camera {
  public:
    Camera(CameraSettings const& settings, int width, int height);

    // The ray through picture point (x, y), from lens point `lens` of the unit square (unused by a pinhole).
    Ray ray(float x, float y, Sample2 lens) const;

    // What a pixel in the middle of the picture sees; the lens is left out.
    RayCone pixel_cone() const;

  private:
    CameraSettings::Projection projection_;
    Vector eye_, forward_, right_, up_;  // right_ and up_ scaled to half a picture at distance 1 (or to the window)
    float scale_x_, scale_y_;            // pixels -> [-1, 1]
    float aperture_radius_, focus_distance_;
};

}  // namespace iride
