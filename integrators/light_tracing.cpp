// SPDX-License-Identifier: Apache-2.0
#include "integrators/light_tracing.h"

#include <fmt/format.h>

#include <algorithm>

#include "integrators/light_walk.h"

namespace iride {

namespace {

class LightTracing final : public Integrator {
  public:
    LightTracing(Scene const& scene, RenderPlan const& plan, std::vector<std::string> remarks)
        : context_(scene, plan), remarks_(std::move(remarks)) {}

    void follow(Scene const& scene, std::span<CameraPath> paths, RayStatistics& statistics) const override {
        Sightings sightings;
        std::array<LightWalk<BalanceHeuristic>, batch_size> walks;
        auto const show = [&](CameraPath& path, std::optional<SentToCamera> const& sent) {
            sightings.add(path, sent, scene, statistics);
        };
        walk_from_lights<BalanceHeuristic>(
            scene, context_, LampEmission{}, paths, walks, statistics,
            [&](CameraPath& path, LightStart const& start, Sample2 lens) {
                show(path, lamp_itself(scene, path.wavelengths, start, lens));
            },
            [&](CameraPath& path, LightVertex<BalanceHeuristic> const& here, Flux const& flux, Sample2 lens) {
                show(path, send_to_camera(scene, context_, path.wavelengths, here, flux, lens, false));
            });
        sightings.trace(scene, statistics);
    }
    bool splats() const override { return true; }
    std::vector<std::string> remarks() const override { return remarks_; }

  private:
    // The place on the lamp, as the camera sees it.
    std::optional<SentToCamera> lamp_itself(Scene const& scene, Wavelengths const& wavelengths, LightStart const& start,
                                            Sample2 lens) const {
        EmissionSample const& e = start.sample;
        Light const& light = scene.lights.light(start.light);
        if (light.extent() != LightExtent::area) return std::nullopt;
        auto const sight = context_.camera.sight_of(e.from.position, lens);
        if (!sight) return std::nullopt;
        float const cosine = std::abs(sight->towards.dot(e.from.geometric_normal));
        float const scale = cosine * sight->density / (start.probability * e.density.area.value);
        Radiance Le = light.emitted(e.from, sight->towards, wavelengths) * scale;
        Vector const origin = spawn_ray(e.from, sight->towards).origin;
        if (auto const in = context_.lamps_in.at(scene, start.light, origin))
            Le *= in->medium().transmittance(sight->distance, wavelengths);
        return send(e.from, *sight, Le);
    }

    TwoWayContext context_;
    std::vector<std::string> remarks_;
};

bool has_dirac_lobe(NamedMaterial const& m) {
    return m.type != "black" && (!m.material->traits.has_density || m.type == "plastic");
}

}  // namespace

std::string why_no_light_paths(Scene const& scene, RenderPlan const& plan) {
    std::string const camera = CameraImportance::why_unsupported(scene.camera);
    if (!camera.empty()) return camera;
    if (plan.scattering) return "a medium scatters, and light paths do not";
    if (!scene.lights.has_power()) return "no light has any power";
    return {};
}

void check_light_paths_possible(Scene const& scene, RenderPlan const& plan, char const* integrator) {
    std::string const why = why_no_light_paths(scene, plan);
    if (!why.empty())
        throw InputError({}, "integrator",
                         fmt::format("'{}' cannot render this scene: {}; 'path' can", integrator, why));
}

std::unique_ptr<Integrator> make_light_tracing(Scene const& scene, RenderPlan const& plan, IntegratorOptions&) {
    constexpr char const* name = "light-tracing";
    check_light_paths_possible(scene, plan, name);
    if (std::ranges::none_of(scene.materials, [](NamedMaterial const& m) { return m.material->traits.has_density; }))
        throw InputError({}, "integrator",
                         fmt::format("'{}' cannot render this scene: every surface is a mirror, glass or black, and no "
                                     "light path can be shown to the camera; 'path' can",
                                     name));
    std::vector<std::string> remarks;
    std::string const mirrors = names_of(scene, has_dirac_lobe);
    if (!mirrors.empty())
        remarks.push_back(
            fmt::format("{} leaves out what the camera sees by way of mirror images and glass: {}", name, mirrors));
    if (!scene.lights.environments().empty())
        remarks.push_back(fmt::format("{} leaves out light from infinity where the camera sees it directly", name));
    return std::make_unique<LightTracing>(scene, plan, std::move(remarks));
}

}  // namespace iride
