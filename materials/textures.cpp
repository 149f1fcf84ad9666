// SPDX-License-Identifier: Apache-2.0
#include "materials/textures.h"

namespace iride {

Vector2 PictureScalar::gradient(SurfacePoint const& point) const {
    float const texels = std::exp2(picture_->level_of(point, mapping_));  // of the picture, in one of the level
    auto const& full = picture_->level[0];
    Vector2 const half_texel = Vector2(texels / (2 * static_cast<float>(full.width) * mapping_.scale.x()),
                                       texels / (2 * static_cast<float>(full.height) * mapping_.scale.y()));
    auto const slope = [&](Vector2 const& step, float length) {
        SurfacePoint before = point, behind = point;
        before.uv -= step;
        behind.uv += step;
        return (at(behind) - at(before)) / (2 * length);
    };
    return {slope({half_texel.x(), 0}, half_texel.x()), slope({0, half_texel.y()}, half_texel.y())};
}

float Checker::mean_wave(float x, float width) {
    // The square wave's integral is the triangle wave.
    auto const phase = [](float at) { return at - 2 * std::floor(at / 2); };
    auto const triangle = [&](float at) { return 1 - std::abs(1 - phase(at)); };
    constexpr float sharp = 1e-3f;  // of a square: less blur than rounding shows
    if (width < sharp) return phase(x) < 1 ? 1.0f : -1.0f;
    return (triangle(x + width / 2) - triangle(x - width / 2)) / width;
}

}  // namespace iride
