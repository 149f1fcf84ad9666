// SPDX-License-Identifier: Apache-2.0
// From the catalogue through loader, intersection and closures: a prism turns each wavelength by
//   delta = theta1 + theta2 - A,   sin theta1 = n sin r1,  r1 + r2 = A,  sin theta2 = n sin r2,
// least where n = sin((A + delta) / 2) / sin(A / 2), and a glass face reflects ((n - 1) / (n + 1))^2.
#include <catch2/catch.hpp>

#include "spectral/catalogue.h"
#include "support/files.h"
#include "support/scenes.h"

using namespace iride;

namespace {

// The shipped prism, of another glass if one is named.
std::unique_ptr<Scene> prism_of(std::string const& glass) {
    std::string text = test::content(find_scene("prism"));
    std::string const shipped = "\"data\": \"SF11\"";
    REQUIRE(text.find(shipped) != std::string::npos);
    return test::scene_from(text.replace(text.find(shipped), shipped.size(), "\"data\": \"" + glass + "\""));
}

// A packet with lane 0 at `nm` and the others elsewhere.
Wavelengths packet_at(double nm, WavelengthGrid const& grid) {
    Wavelengths w{};
    for (int i = 0; i < lane_count; ++i) {
        double const at = i == 0 ? nm : 380 + 50.5 * i;
        w.nm[i] = static_cast<float>(at);
        w.cell[i] = static_cast<int>(at) - grid.first_nm;
        w.fraction[i] = static_cast<float>(at - std::floor(at));
        w.density.set(i, 1.0f / 470);
    }
    return w;
}

struct Surface {
    Hit hit;
    Bsdf bsdf;
    Frame frame;
    Direction wo;
};
Surface met(Scene const& scene, Ray const& ray, Wavelengths const& w) {
    RayStatistics statistics;
    auto const hit = scene.accelerator->closest(ray, statistics);
    REQUIRE(hit);
    Frame const frame = Frame::around(hit->point.normal);
    return {*hit, scene.material(hit->shape->material).at(hit->point, w), frame, frame.to_local(-ray.direction)};
}

// Through the boundary: the number that chooses the lobe is as large as can be.
Ray refracted(Scene const& scene, Ray const& ray, Wavelengths const& w) {
    Surface const s = met(scene, ray, w);
    auto const sample = s.bsdf.sample(s.wo, {one_minus_epsilon, {.5f, .5f}});
    REQUIRE(sample);
    REQUIRE(sample->wi.z() * s.wo.z() < 0);
    return spawn_ray(s.hit.point, s.frame.to_world(sample->wi));
}

// The prism's cross-section: its vertices 0, 1, 2, the light enters between 2 and 1 and leaves between 1 and 0.
struct CrossSection {
    VectorDouble apex, low, entrance_normal, along;  // along: from the base to the apex
    double angle;

    explicit CrossSection(Scene const& scene) {
        Mesh const& mesh = *std::get<MeshShape>(scene.shapes.front().geometry).mesh;
        auto const at = [&](std::size_t i) {
            VectorDouble p = mesh.position[i].cast<double>();
            p.y() = 0;
            return p;
        };
        apex = at(1);
        low = at(2);
        along = (apex - low).normalized();
        VectorDouble const other = (apex - at(0)).normalized();
        angle = std::acos(along.dot(other));
        entrance_normal = (-other + along * along.dot(other)).normalized();  // away from vertex 0 ...
        entrance_normal *= entrance_normal.dot(at(0) - apex) < 0 ? 1 : -1;   // ... and so out of the glass
    }

    double traced_deviation(Scene const& scene, double theta1, double nm) const {
        VectorDouble const travel = -std::cos(theta1) * entrance_normal + std::sin(theta1) * along;
        VectorDouble const entrance = apex + 0.35 * (low - apex);
        Wavelengths const w = packet_at(nm, scene.grid);
        Ray const in{(entrance - 2 * travel).cast<float>(), travel.normalized().cast<float>()};
        VectorDouble const out = refracted(scene, refracted(scene, in, w), w).direction.cast<double>();
        VectorDouble const before = in.direction.cast<double>();
        return std::atan2(before.cross(out).norm(), before.dot(out));
    }
};

}  // namespace

// Fails for one index at all wavelengths (by .1), for the index of the next nanometre, for inside and outside
// exchanged, and for Snell's law with the index ratio turned over.
TEST_CASE("a prism turns each wavelength by Snell's law at both faces", "[law]") {
    for (std::string const glass : {"SF11", "BK7"}) {
        auto const scene = prism_of(glass);
        CrossSection const prism(*scene);
        double const A = prism.angle;
        CHECK(A == Approx(radians(60.)).margin(1e-6));
        constexpr double rounding = 4e-6;  // of float directions, at an exit as flat as 75 degrees
        double last = pi_double;
        for (double nm : {400., 450., 486., 532., 588., 633., 700.}) {
            double const n = load_complex_index(glass).n.at(nm);
            double const theta_least = std::asin(n * std::sin(A / 2)), least = 2 * theta_least - A;
            for (double theta1 : {theta_least - .08, theta_least, theta_least + .2}) {
                double const theta2 = std::asin(n * std::sin(A - std::asin(std::sin(theta1) / n)));
                double const traced = prism.traced_deviation(*scene, theta1, nm);
                INFO(glass << " " << nm << " nm, incidence " << theta1);
                CHECK(traced == Approx(theta1 + theta2 - A).margin(rounding).epsilon(0));
                CHECK(traced > least - rounding);
                if (theta1 == theta_least)
                    CHECK(std::sin((A + traced) / 2) / std::sin(A / 2) == Approx(n).margin(rounding).epsilon(0));
            }
            CHECK(least < last);  // blue is turned most
            last = least;
        }
    }
}

// n = 1.5168 at the d line. The lobe is reflection for random numbers below the reflectance.
TEST_CASE("a face of BK7 reflects .042165 of yellow light at normal incidence", "[law]") {
    auto const scene = prism_of("BK7");
    CrossSection const prism(*scene);
    VectorDouble const on = (prism.apex + prism.low) / 2 + prism.entrance_normal;
    Ray const ray{on.cast<float>(), (-prism.entrance_normal).cast<float>()};
    Surface const face = met(*scene, ray, packet_at(587.6, scene->grid));
    double const R = square((1.5168 - 1) / (1.5168 + 1));
    CHECK(R == Approx(.042165).margin(5e-7).epsilon(0));
    auto const goes_back = [&](double lobe) {
        auto const s = face.bsdf.sample(face.wo, {static_cast<float>(lobe), {.5f, .5f}});
        return s && s->wi.z() > 0;
    };
    CHECK(goes_back(R - 2e-6));
    CHECK(!goes_back(R + 2e-6));
}
