// SPDX-License-Identifier: Apache-2.0
// Lines uniform among all that meet a sphere around the scene: through two points uniform on it. Each passes through
// all it meets; between its meetings two patches face each other. A patch of area A is met 2 A / (4 pi R^2) times a
// line on average. [Sbert 1993]
#pragma once

#include <algorithm>

#include "base/warp.h"
#include "integrators/radiosity/patches.h"

namespace iride::radiosity {

class GlobalLines {
  public:
    GlobalLines(PatchMesh const& mesh, PatchTracer const& tracer) : tracer_(tracer) {
        VectorDouble low = mesh.position.front(), high = low;
        for (VectorDouble const& p : mesh.position) low = low.cwiseMin(p), high = high.cwiseMax(p);
        centre_ = (low + high) / 2;
        constexpr double clear_of_corners = 1.001;
        radius_ = (high - low).norm() / 2 * clear_of_corners;
    }

    double meetings(double area) const { return area / (2 * pi_double * radius_ * radius_); }

    // Calls meets(patch) for every side that line `number` touches and faces(i, j) for those that see each other.
    template <class Meets, class Faces>
    void follow(std::uint32_t series, std::uint32_t number, Meets const& meets, Faces const& faces) const {
        Sampler sampler(SamplerKind::sobol, 2, series, number);
        VectorDouble from = centre_ + radius_ * to_sphere(sampler.next2()).cast<double>();
        VectorDouble const end = centre_ + radius_ * to_sphere(sampler.next2()).cast<double>();
        VectorDouble const way = (end - from).normalized();
        // What lies before the line's next meeting: nothing yet, the dark inside of a body, or what a patch sees. A
        // patch under a body is not met.
        constexpr int open = -1, dark = -2;
        int before = open;
        VectorDouble clear = VectorDouble::Zero();
        for (auto hit = tracer_.closest(from, clear, way); hit; hit = tracer_.closest(from, clear, way)) {
            if (before != dark && hit->patch >= 0) {
                meets(hit->patch);
                if (before >= 0) meets(before), faces(before, hit->patch);
            }
            before = hit->other_side >= 0 ? hit->other_side : dark;
            from = hit->position;
            clear = way;
        }
        if (before >= 0) meets(before);
    }

  private:
    PatchTracer const& tracer_;
    VectorDouble centre_;
    double radius_;
};

}  // namespace iride::radiosity
