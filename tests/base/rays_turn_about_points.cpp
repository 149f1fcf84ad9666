// SPDX-License-Identifier: Apache-2.0
// Parts of rays that lie in a cone, and distances by equal angles about a point, against the geometry in double.
#include <catch2/catch.hpp>

#include "base/equiangular.h"
#include "base/warp.h"

using namespace iride;

namespace {

struct Configuration {
    Ray ray;
    Vector point;
    Direction axis;
};
Configuration configuration(std::uint32_t i) {
    Sampler numbers(SamplerKind::independent, 77, 0, i);
    auto const place = [&] { return Vector(4 * to_sphere(numbers.next2()) * numbers.next()); };
    Vector const from = place();
    return {{from, to_sphere(numbers.next2())}, place(), to_sphere(numbers.next2())};
}

double angle_between(VectorDouble const& a, VectorDouble const& b) { return std::atan2(a.cross(b).norm(), a.dot(b)); }

VectorDouble to_place(Configuration const& c, double t) {
    return c.ray.origin.cast<double>() + t * c.ray.direction.cast<double>() - c.point.cast<double>();
}

}  // namespace

// Fails if the cone's other half is taken for it, or the root that is behind the tip; from far away, if squares of the
// whole way are subtracted.
TEST_CASE("a place of a ray is in the part in a cone just where it is in the cone", "[law]") {
    for (float const away : {0.f, 100.f})
        for (float const degrees : {1.f, 30.f, 75.f, 90.f})
            for (std::uint32_t i = 0; i < 2000; ++i) {
                auto c = configuration(i);
                c.ray.origin -= away * c.ray.direction;
                auto const cosine =
                    degrees == 90 ? 0 : static_cast<float>(std::cos(radians(static_cast<double>(degrees))));
                RayPart const part = part_in_cone(c.ray, c.point, c.axis, cosine);
                for (double t : {.01, .3, 1., 2.5, 7., 40.}) {
                    t += double(away);
                    VectorDouble const v = to_place(c, t);
                    double const within =
                        radians(static_cast<double>(degrees)) - angle_between(v, c.axis.cast<double>());
                    double const rounding = 1e-4 + 1e-6 * double(away) / v.norm();
                    if (std::abs(within) < rounding) continue;  // on the edge, as far as floats know
                    INFO(degrees << " degrees, " << i << ", t " << t << ", part " << part.from << " .. " << part.to);
                    CHECK((part.from < t && t < part.to) == (within > 0));
                }
            }
}

// Near the point, far from it, past it, and on the way to infinity. The angle's own rounding is 1e-7; a place that the
// ray passes at the distance h of a point t away turns by h / t^2 per metre there.
TEST_CASE("equal angles about a point are what the ray sweeps", "[law]") {
    for (std::uint32_t i = 0; i < 2000; ++i) {
        auto const c = configuration(i);
        Equiangular const about(c.ray, c.point);
        for (RayPart const& part : {RayPart{0, 1}, {.2f, 30}, {5, 5.1f}, {0, infinity}, {3, infinity}}) {
            double const to_end = part.to == infinity
                                      ? angle_between(to_place(c, double(part.from)), c.ray.direction.cast<double>())
                                      : angle_between(to_place(c, double(part.from)), to_place(c, double(part.to)));
            float const angle = about.angle(part);
            INFO(i << ", " << part.from << " .. " << part.to);
            CHECK(static_cast<double>(angle) == Approx(to_end).epsilon(2e-5).margin(2e-6));
            for (float u : {.1f, .5f, .9f}) {
                float const t = about.turned(part.from, u * angle);
                double const swept = angle_between(to_place(c, double(part.from)), to_place(c, double(t)));
                CHECK(swept == Approx(double(u) * to_end).epsilon(5e-5).margin(5e-6));
            }
            float const t = about.turned(part.from, .4f * angle);
            double const dt = 1e-3 * to_place(c, double(t)).norm();
            double const slope = angle_between(to_place(c, double(t) - dt), to_place(c, double(t) + dt)) / (2 * dt);
            CHECK(static_cast<double>(about.angle_per_metre(t)) == Approx(slope).epsilon(1e-4));
        }
    }
}
