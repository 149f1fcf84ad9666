// SPDX-License-Identifier: Apache-2.0
#include "integrators/radiosity/lit_backs.h"

#include <tbb/parallel_for.h>

#include "integrators/radiosity/exposure.h"
#include "integrators/radiosity/patch_spectra.h"

namespace iride::radiosity {

namespace {

class LightSeeker {
  public:
    LightSeeker(Scene const& scene, PatchMesh const& mesh, PatchTracer const& tracer)
        : scene_(scene),
          mesh_(mesh),
          tracer_(tracer),
          wavelengths_(packet_of({scene.wavelengths.min_nm}, 0, scene.grid)) {}

    // Whether a path of reflections from a point of a side meets light. Reflections happen a little before the surface,
    // on the way there: next to an edge, a step off the surface might lead out of a body.
    bool finds_light(VectorDouble const& start, VectorDouble side, Sampler sampler) const {
        constexpr int reflections = 8;
        double const before = tracer_.clearance();
        VectorDouble at = start, off = side;
        for (int k = 0; k <= reflections; ++k) {
            if (is_shone_on(at, off, side, sampler)) return true;
            VectorDouble const way = way_by_cosine(side, sampler);
            auto const hit = tracer_.closest(at, off, way);
            if (!hit) return false;
            if (meets_lamp(*hit)) return true;
            if ((hit->position - at).norm() < 2 * before) return false;
            at = hit->position - before * way;
            off.setZero();
            side = front_of(*hit).normal * (hit->patch >= 0 ? 1 : -1);
        }
        return false;
    }

  private:
    bool is_shone_on(VectorDouble const& at, VectorDouble const& off, VectorDouble const& side,
                     Sampler& sampler) const {
        std::size_t const lights = scene_.lights.size();
        if (lights == 0) return false;
        auto const drawn = std::min(static_cast<std::size_t>(sampler.next() * static_cast<float>(lights)), lights - 1);
        Light const& light = scene_.lights.light(static_cast<int>(drawn));
        auto const s = light.sample(at.cast<float>(), wavelengths_, sampler.next2());
        if (!s || s->wi.cast<double>().dot(side) <= 0) return false;
        auto const hit = tracer_.closest(at, off, s->wi.cast<double>());
        if (s->density && !light.is_environment()) return hit && meets_lamp(*hit);
        return !hit || (hit->position - at).norm() > static_cast<double>(s->distance);
    }
    Patch const& front_of(PatchHit const& hit) const {
        return mesh_.patch[static_cast<std::size_t>(std::max(hit.patch, hit.other_side))];
    }
    bool meets_lamp(PatchHit const& hit) const {
        return hit.patch >= 0 && mesh_.shape[static_cast<std::size_t>(front_of(hit).shape)]->light >= 0;
    }

    Scene const& scene_;
    PatchMesh const& mesh_;
    PatchTracer const& tracer_;
    Wavelengths wavelengths_;
};

}  // namespace

std::vector<bool> lit_backs(Scene const& scene, PatchMesh const& fronts, PatchTracer const& tracer) {
    constexpr std::uint32_t paths = 256;  // of a back
    LightSeeker const seeker(scene, fronts, tracer);
    std::vector<std::vector<std::size_t>> of_shape(fronts.shape.size());
    for (std::size_t i = 0; i < fronts.patch.size(); ++i)
        of_shape[static_cast<std::size_t>(fronts.patch[i].shape)].push_back(i);
    std::vector<char> lit(fronts.shape.size(), 0);
    tbb::parallel_for(std::size_t{0}, lit.size(), [&](std::size_t s) {
        auto const& own = of_shape[s];
        for (std::uint32_t path = 0; path < paths && !own.empty() && !lit[s]; ++path) {
            std::size_t const i = own[path * own.size() / paths];
            Patch const& p = fronts.patch[i];
            Sampler sampler(SamplerKind::sobol, 0, static_cast<std::uint32_t>(i), path);
            VectorDouble const at = (p.centre + point_on(fronts, p, sampler.next2())) / 2;  // away from edges
            lit[s] = seeker.finds_light(at, -p.normal, sampler);
        }
    });
    return {lit.begin(), lit.end()};
}

}  // namespace iride::radiosity
