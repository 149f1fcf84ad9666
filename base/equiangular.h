// SPDX-License-Identifier: Apache-2.0
// Equiangular sampling: distances t along a ray, with a density that falls off as the squared distance from a point.
// With h the perpendicular from the point and t_0 its foot, the ray sweeps the angle a about the point,
//   da / dt = h / (h^2 + (t - t_0)^2)
// and from the distance b, turned on by a, it is, with s = b - t_0, at
//   t = b + (h^2 + s^2) sin a / (h cos a - s sin a)
// which is the tangent of a sum, written so that nothing cancels far from the point. Uniform angles have the density
// (da / dt) / (all the angle). [Kulla 2012]
#pragma once

#include "base/ray_part.h"
#include "base/trigonometry.h"

namespace iride {

class Equiangular {
  public:
    Equiangular(Ray const& ray, Vector const& point) {
        constexpr float nearest = 1e-6f;    // of the way to the point: below it h is rounding
        constexpr float nearest2 = 1e-20f;  // m^2: squares of distances and their reciprocals stay in range
        Vector const from_point = ray.origin - point;
        foot_ = -from_point.dot(ray.direction);
        height2_ =
            (from_point + foot_ * ray.direction).squaredNorm() + square(nearest) * from_point.squaredNorm() + nearest2;
        height_ = std::sqrt(height2_);
    }

    // That a part subtends at the point, in 0 .. pi.
    float angle(RayPart const& part) const {
        float const s = part.from - foot_;
        if (part.to == infinity) return arctangent(height_, s);
        return arctangent(height_ * (part.to - part.from), height2_ + s * (part.to - foot_));
    }
    float turned(float from, float angle) const {
        auto const [sine, cosine] = sine_cosine_of_turns(angle / (2 * pi));
        float const s = from - foot_;
        return from + (height2_ + square(s)) * sine / (height_ * cosine - s * sine);
    }
    float angle_per_metre(float t) const { return height_ / (height2_ + square(t - foot_)); }

  private:
    float foot_, height_, height2_;
};

}  // namespace iride
