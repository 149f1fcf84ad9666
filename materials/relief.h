// SPDX-License-Identifier: Apache-2.0
// Normals of a surface with more relief than its shape has: they turn, the surface stays where it is.
//   bump        n' ~ n - grad h, h a height along the front normal [m]; with dp/du and dp/dv across n this is Blinn's
//               n + (h_u n x p_v - h_v n x p_u) / |p_u x p_v|. What it leaves out is h itself: the normal of the truly
//               displaced surface has (p_u + h n_u) for p_u. [Blinn 1978]
//   normal map  n' = x t + y b + z n, (x, y, z) = 2 rgb - 1; t along dp/du, b across it on the side of dp/dv (+v is up)
#pragma once

#include <array>

#include "materials/surface_map.h"
#include "materials/texture.h"

namespace iride {

class Relief {
  public:
    virtual ~Relief() = default;
    // Unit, on the front side of point.normal; for light on either side of the surface.
    virtual Direction normal_at(SurfacePoint const& point) const = 0;
};

class BumpMap final : public Relief {
  public:
    // height_m: what 1 in the map stands for.
    BumpMap(ScalarMap height, float height_m) : height_(std::move(height)), height_m_(height_m) {}
    Direction normal_at(SurfacePoint const& point) const override;

  private:
    ScalarMap height_;
    float height_m_;
};

class NormalMap final : public Relief {
  public:
    using Pyramid = TexturePyramid<Eigen::Array3f>;  // decoded: (x, y, z)
    NormalMap(std::shared_ptr<Pyramid const> picture, TextureMapping const& mapping)
        : picture_(std::move(picture)), mapping_(mapping) {}
    Direction normal_at(SurfacePoint const& point) const override;

  private:
    std::shared_ptr<Pyramid const> picture_;
    TextureMapping mapping_;
};

}  // namespace iride
