// SPDX-License-Identifier: Apache-2.0
// A pane's closed form against the light followed from face to face, one echo after the other.
#include <catch2/catch.hpp>

#include "support/bsdf_models.h"

using namespace iride;

namespace {

struct Power {
    double R, T;
};
// One polarisation: F of a face, t of a crossing.
Power echo_by_echo(double F, double t) {
    Power sum{F, 0};
    double inside = (1 - F) * t;  // arriving at a face
    for (int faces = 0; faces < 20000; ++faces, inside *= F * t) (faces % 2 == 0 ? sum.T : sum.R) += inside * (1 - F);
    return sum;
}
Power pane(double angle_deg, double n, double depth) {
    double const sine = std::sin(radians(angle_deg)) / n;
    auto const F = fresnel(std::cos(radians(angle_deg)), n, 0.0);
    double const t = std::exp(-depth / std::sqrt(1 - sine * sine));
    Power const s = echo_by_echo(F.s, t), p = echo_by_echo(F.p, t);
    return {(s.R + p.R) / 2, (s.T + p.T) / 2};
}

Direction at_angle(double degrees) {
    return VectorDouble(std::sin(radians(degrees)), 0, std::cos(radians(degrees))).cast<float>();
}

}  // namespace

// Fails for the first order alone (R = F), for a crossing along the normal instead of the refracted ray, for echoes of
// F instead of F t, and with the reflectance of unpolarised light in place of the two polarisations (by .012 at 60
// degrees).
TEST_CASE("a pane reflects and transmits the sum of all echoes", "[law]") {
    Lanes const n = test::rising_lanes(1.3f, .1f), depth = test::rising_lanes(0, .2f);
    for (double angle : {0., 30., 60., 80., 89.}) {
        Lanes R, T;
        ThinSlab{n, depth}.power(at_angle(angle).z(), R, T);
        for (int i = 0; i < lane_count; ++i) {
            INFO(angle << " degrees, lane " << i);
            Power const wanted = pane(angle, static_cast<double>(n[i]), static_cast<double>(depth[i]));
            CHECK(R[i] == Approx(wanted.R).margin(2e-5).epsilon(0));
            CHECK(T[i] == Approx(wanted.T).margin(2e-5).epsilon(0));
            if (depth[i] == 0) CHECK(R[i] + T[i] == Approx(1).margin(1e-6).epsilon(0));
        }
    }
}

// Fails when the choice goes by the hero's reflectance and the weights do not follow.
TEST_CASE("a pane's two lobes bring each lane its R and T, whatever the hero has", "[law]") {
    Lanes depth(0.0f);
    depth.set(0, 1e4f);  // nothing gets through at the hero's wavelength
    ThinSlab const slab{test::rising_lanes(1.3f, .1f), depth};
    Direction const wo = at_angle(50);
    Lanes R, T, from_reflection, from_transmission;
    slab.power(wo.z(), R, T);
    constexpr int steps = 4096;
    for (int i = 0; i < steps; ++i) {
        auto const s = slab.sample(wo, {(static_cast<float>(i) + .5f) / steps, {.5f, .5f}});
        REQUIRE(s);
        CHECK(!s->density);
        CHECK(s->reach[lane_count - 1] == 1);
        bool const through = s->wi.z() < 0;
        CHECK((through ? (s->wi + wo).norm() : (s->wi - Direction(-wo.x(), -wo.y(), wo.z())).norm()) == 0);
        (through ? from_transmission : from_reflection) += s->weight * (1.0f / steps);
    }
    for (int i = 0; i < lane_count; ++i) {
        CHECK(from_reflection[i] == Approx(R[i]).epsilon(2e-3));
        CHECK(from_transmission[i] == Approx(T[i]).epsilon(2e-3));
    }
}

TEST_CASE("a pane stands grazing light, total reflection and darkness", "[unit]") {
    for (float n : {.5f, 1.0f, 1.5f})
        for (float depth : {0.0f, 1.0f, 1e30f})
            for (float cosine : {1.0f, .5f, 1e-3f, 1e-20f, 0.0f}) {
                Lanes R, T;
                ThinSlab{Lanes(n), Lanes(depth)}.power(cosine, R, T);
                INFO(n << " " << depth << " " << cosine);
                CHECK(is_finite(R));
                CHECK(is_finite(T));
                CHECK((R[0] >= 0 && T[0] >= 0 && R[0] + T[0] <= 1.00001f));
            }
}
