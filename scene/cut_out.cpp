// SPDX-License-Identifier: Apache-2.0
#include "scene/cut_out.h"

#include <bit>
#include <cmath>

#include "base/random.h"

namespace iride {

namespace {

float share_of(Ray const& ray, float distance, HitCoordinates const& at) {
    auto const pair = [](float x, float y) {
        return static_cast<std::uint64_t>(std::bit_cast<std::uint32_t>(x)) << 32 | std::bit_cast<std::uint32_t>(y);
    };
    std::uint64_t const hash =
        hash_words(pair(ray.origin.x(), ray.origin.y()), pair(ray.origin.z(), ray.direction.x()),
                   pair(ray.direction.y(), ray.direction.z()), pair(distance, at.u), at.primitive);
    return to_unit_float(static_cast<std::uint32_t>(hash >> 32));
}

}  // namespace

bool stops(Shape const& shape, Ray const& ray, float distance, HitCoordinates const& at) {
    if (!shape.alpha) return true;
    SurfacePoint point;
    Vector const on_ray = ray.origin + distance * ray.direction;
    std::visit([&](auto const& g) { locate(g, on_ray, at, point); }, shape.geometry);
    parametrise(shape.geometry, at, point);
    float const alpha = shape.alpha->at(point);
    if (alpha >= 1 || alpha <= 0) return alpha >= 1;
    return share_of(ray, distance, at) < alpha;
}

std::optional<float> first_stop(Shape const& shape, Frustum const& frustum, Ray ray) {
    for (;;) {
        std::optional<float> const t = intersect(frustum, ray);
        if (!t || stops(shape, ray, *t, {0, 0, 0})) return t;
        ray.t_min = std::nextafter(*t, infinity);  // the root, in double, may lie above its float
    }
}

}  // namespace iride
