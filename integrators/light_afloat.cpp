// SPDX-License-Identifier: Apache-2.0
#include "integrators/light_afloat.h"

namespace iride {

namespace {

// Around all surfaces, all lamps and the camera, and not smaller than the shortest free path: fog glows that far.
Ball ball_around(Scene const& scene, RenderPlan const& plan) {
    Eigen::AlignedBox3f box(scene.accelerator->lower_bound(), scene.accelerator->upper_bound());
    box.extend(scene.camera.eye.cast<float>());
    for (std::size_t i = 0; i < scene.lights.size(); ++i)
        if (auto const lamp = scene.lights.light(static_cast<int>(i)).bounds())
            box.extend(lamp->lower.cast<float>()).extend(lamp->upper.cast<float>());
    Wavelengths const some =
        WavelengthSampler(plan.wavelengths, SpectralFunction::constant(1), scene.grid).sample(0.5f);
    float const free_path = 1 / largest(scene.open_medium.sigma_t(some)).value;
    return {box.center(), std::max(box.diagonal().norm() / 2, free_path)};
}

}  // namespace

LightAfloat::LightAfloat(Scene const& scene, RenderPlan const& plan, LightSelector const& selector)
    : selector_(&selector), endless_(scene.open_medium.scatters) {
    if (endless_) around_ = ball_around(scene, plan);
    if (!plan.beams) return;
    beams_ = Beams(scene.lights);
    for (Vector const& place : beams_.places()) {
        Medium const& medium = surroundings_at(scene, place).medium();
        if (medium.scatters && std::ranges::find(lit_, &medium) == lit_.end()) lit_.push_back(&medium);
    }
    if (lit_.empty()) beams_ = {};
}

bool LightAfloat::has_beams(Medium const& medium) const { return std::ranges::find(lit_, &medium) != lit_.end(); }

Lanes LightAfloat::by_flight(Medium const& medium, Wavelengths const& wavelengths, Lanes const& passed,
                             Vector const& place, int light) const {
    float const asked = selector_->probability({place, Vector(0, 0, 0)}, light);
    return asked * passed * Lanes(medium.sigma_t(wavelengths).lane);
}

float LightAfloat::by_beam(Scene const& scene, Walk const& walk, Vector const& place, int light,
                           Direction const& to_lamp, float lamp_distance) const {
    Arrival const& arrival = walk.arrival;
    if (!arrival.density) return 0;
    return arrival.mean_reach_before / arrival.density->value *
           beams_.density_on_beam(scene.lights, arrival.from.position, place, light, to_lamp, lamp_distance);
}

void LightAfloat::look_along(Scene const& scene, CameraPath& path, Walk& walk, Shadows& shadows,
                             RayStatistics& statistics) const {
    walk.floating.reach_before = mean(walk.state.reach);
    Hit const* const hit = walk.has_hit ? &walk.hit : nullptr;
    Medium const& medium = medium_before(scene, hit, path.ray, walk.in);
    if (!has_beams(medium)) return;
    FlightNumbers const& u = walk.floating.numbers;
    auto const on = beams_.on_ray(path.ray, hit ? hit->distance : infinity, {u.lamp, u.places.x});
    if (!on) return;
    Vector const place = path.ray.origin + on->distance * path.ray.direction;
    auto const light = scene.lights.light(on->light).sample(place, path.wavelengths, {});
    if (!light) return;
    Lanes const passed(medium.transmittance(on->distance, path.wavelengths));
    Lanes const along = Lanes(on->density) + by_flight(medium, path.wavelengths, passed, place, on->light);
    float const divisor =
        float(mean(walk.state.reach * along)) + by_beam(scene, walk, place, on->light, light->wi, light->distance);
    float const phase = HenyeyGreenstein(medium.asymmetry, path.ray.direction).density(light->wi).value;
    Lanes const scattered(medium.sigma_s.at(path.wavelengths).lane * (phase * on->share / divisor));
    Radiance const brought = walk.state.weight * passed * scattered *
                             medium.transmittance(light->distance, path.wavelengths) * light->radiance;
    if (is_black(brought)) return;
    if (shadows.is_full()) shadows.trace(scene, statistics);
    shadows.add(path, on->light, brought, shadow_ray(place, light->wi, light->distance));
}

void LightAfloat::weigh(Scene const& scene, CameraPath& path, Walk const& walk, Shadows& shadows) const {
    LightSample const& light = *walk.light;
    Medium const& medium = walk.in.medium();
    Afloat const& at = *walk.floating.at;
    Lanes const passed(medium.transmittance(light.distance, path.wavelengths));
    float const phase = HenyeyGreenstein(medium.asymmetry, path.ray.direction).density(light.wi).value;
    Lanes competitors(walk.choice.probability);
    if (light.density) competitors = phase * passed + Lanes(walk.choice.probability * light.density->value);
    float divisor = mean(walk.state.reach * competitors);
    if (!light.density && has_beams(medium)) {
        float const hero = medium.sigma_t(path.wavelengths).lane[0];
        float const rivals =
            walk.floating.reach_before * beams_.density_on_ray(path.ray, at.distance, walk.choice.light) +
            by_beam(scene, walk, at.position, walk.choice.light, light.wi, light.distance);
        divisor += rivals / (hero * std::exp(-hero * at.distance));
    }
    shadows.add(path, walk.choice.light, walk.state.weight * passed * light.radiance * (phase / divisor),
                shadow_ray(at.position, light.wi, light.distance));
}

std::optional<Beams::OnBeam> LightAfloat::place_on_beam(Scene const& scene, CameraPath const& path,
                                                        Walk const& walk) const {
    if (beams_.none()) return std::nullopt;
    FlightNumbers const& u = walk.floating.numbers;
    return beams_.on_beam(scene.lights, walk.place(), path.wavelengths, {u.lamp, u.places.y}, u.direction);
}

void LightAfloat::look_at_beam(Scene const& scene, Interaction const& here, CameraPath& path, Walk const& walk,
                               Shadows& shadows, RayStatistics& statistics) const {
    if (!is_dense(scene, walk)) return;
    auto const on = place_on_beam(scene, path, walk);
    if (!on) return;
    Direction const wi = here.frame.to_local(on->towards);
    if (!here.is_consistent(on->towards, wi)) return;
    Medium const& medium = behind(scene, walk.hit, here, wi, walk.in).medium();
    if (!has_beams(medium)) return;
    BsdfEvaluation const f = here.bsdf.evaluate(here.wo, wi);
    if (is_black(f.value)) return;
    add_beam(scene, path, walk, *on,
             {Lanes(f.value.lane * std::abs(wi.z())), Lanes(f.density.lane), medium,
              spawn_shadow_ray(walk.hit.point, on->towards, on->distance)},
             shadows, statistics);
}

void LightAfloat::look_at_beam(Scene const& scene, CameraPath& path, Walk const& walk, Shadows& shadows,
                               RayStatistics& statistics) const {
    Medium const& medium = walk.in.medium();
    if (!has_beams(medium)) return;
    auto const on = place_on_beam(scene, path, walk);
    if (!on) return;
    Lanes const phase(HenyeyGreenstein(medium.asymmetry, path.ray.direction).density(on->towards).value);
    add_beam(scene, path, walk, *on, {phase, phase, medium, shadow_ray(walk.place(), on->towards, on->distance)},
             shadows, statistics);
}

void LightAfloat::add_beam(Scene const& scene, CameraPath& path, Walk const& walk, Beams::OnBeam const& on,
                           Towards const& seen, Shadows& shadows, RayStatistics& statistics) const {
    if (scene.accelerator->occluded(shadow_ray(on.place, -on.travel, on.lamp_distance), statistics)) return;
    Medium const& medium = seen.medium;
    Lanes const passed(medium.transmittance(on.distance, path.wavelengths));
    Lanes const along = Lanes(beams_.density_on_ray({walk.place(), on.towards}, on.distance, on.light)) +
                        by_flight(medium, path.wavelengths, passed, on.place, on.light);
    float const divisor = mean(walk.state.reach * (Lanes(on.density) + seen.density * along));
    float const phase = HenyeyGreenstein(medium.asymmetry, on.travel).density(-on.towards).value;
    Lanes const scattered(medium.sigma_s.at(path.wavelengths).lane * (phase / (square(on.lamp_distance) * divisor)));
    Radiance const brought = walk.state.weight * seen.value * passed * scattered *
                             medium.transmittance(on.lamp_distance, path.wavelengths) * on.intensity;
    if (!is_black(brought)) shadows.add(path, on.light, brought, seen.ray);
}

}  // namespace iride
