// SPDX-License-Identifier: Apache-2.0
// Parameters of a material that may vary over its surface: reflectances and numbers, the same everywhere or by a
// texture (materials/textures.h).
#pragma once

#include <memory>

#include "materials/surface_point.h"
#include "spectral/spectrum.h"

namespace iride {

class ReflectanceTexture {
  public:
    virtual ~ReflectanceTexture() = default;
    virtual Lanes at(SurfacePoint const& point, Wavelengths const& wavelengths) const = 0;
};

class ReflectanceMap {
  public:
    ReflectanceMap(Reflectance everywhere) : everywhere_(std::move(everywhere)) {}
    ReflectanceMap(std::shared_ptr<ReflectanceTexture const> texture) : texture_(std::move(texture)) {}

    Lanes at(SurfacePoint const& point, Wavelengths const& wavelengths) const {
        return texture_ ? texture_->at(point, wavelengths) : everywhere_.at(wavelengths);
    }
    // Whether at() looks at the point.
    bool varies() const { return texture_ != nullptr; }

  private:
    Reflectance everywhere_;
    std::shared_ptr<ReflectanceTexture const> texture_;
};

struct ScalarRange {
    float least, most;
};

class ScalarTexture {
  public:
    virtual ~ScalarTexture() = default;
    virtual float at(SurfacePoint const& point) const = 0;
    // d value / d(u, v).
    virtual Vector2 gradient(SurfacePoint const& point) const = 0;
    // Between which all values are.
    virtual ScalarRange range() const = 0;
};

class ScalarMap {
  public:
    ScalarMap(float everywhere) : at_zero_(everywhere) {}
    // Where the texture is 0 and 1, the map is at_zero and at_one, linear between and beyond.
    explicit ScalarMap(std::shared_ptr<ScalarTexture const> texture, float at_zero = 0, float at_one = 1)
        : at_zero_(at_zero), span_(at_one - at_zero), texture_(std::move(texture)) {}

    float at(SurfacePoint const& point) const { return texture_ ? at_zero_ + span_ * texture_->at(point) : at_zero_; }
    Vector2 gradient(SurfacePoint const& point) const {
        return texture_ ? Vector2(span_ * texture_->gradient(point)) : Vector2(0, 0);
    }
    ScalarRange range() const {
        if (!texture_) return {at_zero_, at_zero_};
        auto const [least, most] = texture_->range();
        float const a = at_zero_ + span_ * least, b = at_zero_ + span_ * most;
        return {std::min(a, b), std::max(a, b)};
    }
    // Whether at() looks at the point.
    bool varies() const { return texture_ != nullptr; }

  private:
    float at_zero_, span_ = 0;
    std::shared_ptr<ScalarTexture const> texture_;
};

}  // namespace iride
