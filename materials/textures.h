// SPDX-License-Identifier: Apache-2.0
// What varies a parameter over a surface:
//   PictureReflectance   texels are sigmoids [Jakob 2019]: reflectances are interpolated, not their coefficients
//   MixedReflectance     (1 - w) a + w b of two true spectra (or textures), w a scalar map: a checker of spectra, paint
//                        by weights
//   PictureScalar        one channel of a picture
//   Checker              0 and 1 in squares, averaged exactly over the box around the ray's footprint
//   Waves                (1 + cos 2 pi m u cos 2 pi n v) / 2: a formula for bumps; not averaged
#pragma once

#include "materials/surface_map.h"
#include "materials/texture.h"

namespace iride {

// Coefficients of SigmoidShape; 16 bytes, so that one load takes them.
struct alignas(16) SigmoidTexel {
    float a, b, c;
    float unused = 0;

    Lanes at(Lanes const& t) const {
        LaneRegister const x = (a * t.lane + b) * t.lane + c;
        return Lanes(0.5f + 0.5f * x / sqrt(Lanes(1 + x * x)).lane);
    }
    // Wavelengths as the sigmoid takes them: -1 .. 1 over `visible_range`.
    static Lanes argument(Wavelengths const& wavelengths) {
        constexpr auto sum = static_cast<float>(visible_range.min_nm + visible_range.max_nm);
        constexpr auto width = static_cast<float>(visible_range.max_nm - visible_range.min_nm);
        return Lanes((2 * wavelengths.nm - sum) * (1 / width));
    }
    // Beyond it the sigmoid of a grey is as near to 0 or 1 as a float can be, and its square does not overflow.
    static constexpr float steepest_argument = 1e9f;
};

class PictureReflectance final : public ReflectanceTexture {
  public:
    using Pyramid = TexturePyramid<SigmoidTexel>;
    PictureReflectance(std::shared_ptr<Pyramid const> picture, TextureMapping const& mapping)
        : picture_(std::move(picture)), mapping_(mapping) {}

    Lanes at(SurfacePoint const& point, Wavelengths const& wavelengths) const override {
        Lanes const t = SigmoidTexel::argument(wavelengths);
        Lanes sum;
        picture_->visit_texels(point, mapping_,
                               [&](SigmoidTexel const& texel, float weight) { sum += weight * texel.at(t); });
        return min(sum, Lanes(1));  // weights sum to 1 but for rounding
    }

  private:
    std::shared_ptr<Pyramid const> picture_;
    TextureMapping mapping_;
};

class MixedReflectance final : public ReflectanceTexture {
  public:
    MixedReflectance(ScalarMap weight, ReflectanceMap a, ReflectanceMap b)
        : weight_(std::move(weight)), a_(std::move(a)), b_(std::move(b)) {}

    Lanes at(SurfacePoint const& point, Wavelengths const& wavelengths) const override {
        float const w = weight_.at(point);
        return a_.at(point, wavelengths) * (1 - w) + b_.at(point, wavelengths) * w;
    }

  private:
    ScalarMap weight_;
    ReflectanceMap a_, b_;
};

class PictureScalar final : public ScalarTexture {
  public:
    using Pyramid = TexturePyramid<float>;
    // `extent`: of the texels.
    PictureScalar(std::shared_ptr<Pyramid const> picture, TextureMapping const& mapping, ScalarRange extent)
        : picture_(std::move(picture)), mapping_(mapping), extent_(extent) {}

    float at(SurfacePoint const& point) const override {
        float sum = 0;
        picture_->visit_texels(point, mapping_, [&](float texel, float weight) { sum += weight * texel; });
        return std::clamp(sum, extent_.least, extent_.most);  // weights sum to 1 but for rounding
    }
    // Of the picture smoothed by a box of one texel, and so continuous: differences over half a texel to either side.
    Vector2 gradient(SurfacePoint const& point) const override;
    ScalarRange range() const override { return extent_; }

  private:
    std::shared_ptr<Pyramid const> picture_;
    TextureMapping mapping_;
    ScalarRange extent_;
};

class Checker final : public ScalarTexture {
  public:
    // Squares per unit of u and v; 0 where the numbers of the square sum to an even one.
    explicit Checker(Vector2 const& squares) : squares_(squares) {}

    float at(SurfacePoint const& point) const override {
        Vector2 const size = (point.across_ray.cwiseAbs2() + point.along_ray.cwiseAbs2()).cwiseSqrt();
        return 0.5f - 0.5f * mean_wave(squares_.x() * point.uv.x(), std::abs(squares_.x()) * size.x()) *
                          mean_wave(squares_.y() * point.uv.y(), std::abs(squares_.y()) * size.y());
    }
    Vector2 gradient(SurfacePoint const&) const override { return {0, 0}; }
    ScalarRange range() const override { return {0, 1}; }

  private:
    // Mean of the square wave (+1 on [0, 1), -1 on [1, 2), period 2) over `width` about x.
    static float mean_wave(float x, float width);

    Vector2 squares_;
};

class Waves final : public ScalarTexture {
  public:
    // m and n: periods per unit of u and v.
    explicit Waves(Vector2 const& periods) : turn_(2 * pi * periods) {}

    float at(SurfacePoint const& point) const override {
        return 0.5f + 0.5f * std::cos(turn_.x() * point.uv.x()) * std::cos(turn_.y() * point.uv.y());
    }
    Vector2 gradient(SurfacePoint const& point) const override {
        float const x = turn_.x() * point.uv.x(), y = turn_.y() * point.uv.y();
        return {-0.5f * turn_.x() * std::sin(x) * std::cos(y), -0.5f * turn_.y() * std::cos(x) * std::sin(y)};
    }
    ScalarRange range() const override { return {0, 1}; }

  private:
    Vector2 turn_;
};

}  // namespace iride
