// SPDX-License-Identifier: Apache-2.0
// Light paths aimed at mirrors and glass, of which each vertex is shown to the camera, and what they weigh against the
// camera path they go with: what a caustic throws at a diffuse surface they find at once. (integrators/subpath.h)
#pragma once

#include "integrators/light_walk.h"

namespace iride {

using BesideLightPaths = WithoutJoins<BalanceHeuristic>;

class AimedLightPaths {
  public:
    // `share`: of the camera paths that one goes with; absent: the usual one, or what a pilot of splits finds best.
    AimedLightPaths(Scene const& scene, RenderPlan const& plan, AimedEmission emission, std::optional<double> share)
        : context_(scene, plan, plan.light_selection, static_cast<float>(share.value_or(usual_share))),
          emission_(std::move(emission)),
          share_is_free_(!share) {}

    // For a pilot, which looks at the usual share whatever the latest found.
    LightPathsBeside in_pilot(Scene const& scene) {
        if (!share_is_free_) return {};
        context_.share = usual_share;
        return {[&](std::span<CameraPath> paths, Splits const& splits, RayStatistics& statistics) {
                    follow(scene, paths, splits, statistics);
                },
                usual_share};
    }
    // What it found, if anything.
    void set_share(std::optional<float> best) {
        if (best) context_.share = *best;
    }

    // The light paths that go with camera paths: their splats.
    void follow(Scene const& scene, std::span<CameraPath> paths, Splits const& splits,
                RayStatistics& statistics) const {
        Sightings sightings;
        std::array<LightWalk<BesideLightPaths>, batch_size> walks;
        walk_from_lights<BesideLightPaths>(
            scene, context_, emission_, paths, walks, statistics, [](CameraPath&, LightStart const&, Sample2) {},
            [&](CameraPath& path, LightVertex<BesideLightPaths> const& here, Flux const& flux, Sample2 lens) {
                sightings.add(path, send_to_camera(scene, context_, path.wavelengths, here, flux, lens, true, splits),
                              scene, statistics);
            });
        sightings.trace(scene, statistics);
    }

    // How often light paths show the place where a camera's ray ends, over how often parts of camera paths do and
    // the cosine there.
    float per_camera_path(CameraPath const& path, Splits const& splits, float distance) const {
        return context_.light_paths() /
               (static_cast<float>(splits.at(path.x, path.y)) * context_.camera.density(path.ray, distance));
    }
    // The density with which they start where a ray meets a lamp, back along it, over the cosine there.
    float starting(Scene const& scene, Ray const& ray, Hit const& lamp) const {
        Direction const travel = -ray.direction;
        float const cosine = travel.dot(lamp.point.geometric_normal);
        return emission_.density(scene, context_.ball, lamp.shape->light, lamp.point.position, travel, cosine) /
               std::abs(cosine);
    }
    // What they weigh beside a light sample, in its units.
    float instead_of(Scene const& scene, Meeting const& here, Wavelengths const& wavelengths, LightSample const& sample,
                     LightSelector::Choice const& choice, OtherSide<BesideLightPaths> const& other) const {
        float started =
            emission_.density(scene, context_.ball, choice.light, here.point().position + sample.distance * sample.wi,
                              -sample.wi, sample.cosine);
        if (!(started > 0)) return 0;
        if (!sample.density) started /= square(sample.distance);
        return float(mean(other.others(Lanes(here.cosine(sample.wi) / sample.cosine * started),
                                       [&] { return here.density_back(scene, wavelengths, sample.wi); })));
    }

  private:
    static constexpr float usual_share = 0.5f;
    TwoWayContext context_;
    AimedEmission emission_;
    bool share_is_free_;
};

// Option `light_paths`: their number for each camera path. Throws InputError for a scene that has nothing to aim at.
AimedLightPaths light_paths_asked_for(Scene const& scene, RenderPlan const& plan, IntegratorOptions& options,
                                      char const* integrator);

}  // namespace iride
