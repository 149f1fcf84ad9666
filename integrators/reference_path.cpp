// SPDX-License-Identifier: Apache-2.0
// The oracle: follow the BSDF, add what emits, nothing clever. Noisy and right. Lights without extent are the one thing
// that scattering cannot find; they are added directly, there is no other way to reach them.
#include "integrators/flight.h"
#include "integrators/path.h"

namespace iride {

namespace {

class ReferencePath final : public Integrator {
  public:
    explicit ReferencePath(RenderPlan const& plan)
        : max_bounces_(plan.max_bounces.value_or(longest_path)),
          scattering_(plan.scattering),
          camera_in_(plan.media ? plan.camera_in : Surroundings()) {}

    void follow(Scene const& scene, std::span<CameraPath> paths, RayStatistics& statistics) const override {
        for (CameraPath& path : paths) follow_one(scene, path, statistics);
    }

  private:
    void follow_one(Scene const& scene, CameraPath& path, RayStatistics& statistics) const {
        Ray ray = path.ray;
        Wavelengths const& wavelengths = path.wavelengths;
        Sampler& sampler = path.sampler;
        PathState state;
        Surroundings in = camera_in_ ? *camera_in_ : surroundings_at(scene, ray.origin);
        for (int bounce = 0, passed = 0;; ++bounce) {
            sampler.begin_vertex(static_cast<std::uint32_t>(bounce));
            Flight flight(scattering_ ? sampler.next() : 0);
            std::optional<Hit> hit = scene.accelerator->closest(ray, statistics);
            std::optional<Afloat> afloat;
            float passing = 1;  // light samples do not compete here
            while (fly(scene, hit ? &*hit : nullptr, wavelengths, flight, ray, in, state, passing, afloat)) {
                if (hit->shape->light >= 0)
                    path.bring(hit->shape->light,
                               state.weight * emitted_at(scene, *hit, ray, wavelengths) * (1 / mean(state.reach)));
                if (++passed > longest_path) return void(path.complete = false);
                hit = scene.accelerator->closest(ray, statistics);
            }
            // Mixture over lanes only: divide by the mean reach.
            float const per_reach = 1 / mean(state.reach);
            if (afloat && bounce < max_bounces_) {
                if (!scatter_afloat(scene, *afloat, in.medium(), bounce, path, ray, state, statistics)) return;
                continue;
            }
            if (afloat) return void(path.complete = max_bounces_ < longest_path);
            if (!hit) {
                for (int e : scene.lights.environments())
                    path.bring(e,
                               state.weight * scene.lights.light(e).arriving(ray.direction, wavelengths) * per_reach);
                return;
            }
            if (hit->shape->light >= 0)
                path.bring(hit->shape->light, state.weight * emitted_at(scene, *hit, ray, wavelengths) * per_reach);
            if (bounce >= max_bounces_) {
                path.complete = max_bounces_ < longest_path;
                return;
            }

            Sample2 const chances = sampler.next2();  // x: roulette, y: which part of a mixture
            describe_meeting(hit->point, -ray.direction, chances.y);
            Interaction const here(scene, *hit, -ray.direction, wavelengths, &in);
            for (std::size_t i = 0; i < scene.lights.size(); ++i)
                path.bring(static_cast<int>(i),
                           dirac_light(scene, static_cast<int>(i), *hit, here, wavelengths, state, in, statistics));
            auto const sample = here.bsdf.sample(here.wo, {sampler.next(), sampler.next2()});
            if (!sample) return;
            Direction const wi = here.frame.to_world(sample->wi);
            if (!here.is_consistent(wi, sample->wi)) return;
            state.weight *= sample->weight;
            state.reach *= sample->reach;
            in = behind(scene, *hit, here, sample->wi, in);
            ray = spawn_ray(hit->point, wi);
            if (bounce >= 3 && !survives<true>(state, chances.x)) return;
        }
    }

    // A scattering in a medium: what lights without extent bring to it, and where the path goes on; false if it ends.
    static bool scatter_afloat(Scene const& scene, Afloat const& here, Medium const& medium, int bounce,
                               CameraPath& path, Ray& ray, PathState& state, RayStatistics& statistics) {
        HenyeyGreenstein const phase(medium.asymmetry, ray.direction);
        for (std::size_t i = 0; i < scene.lights.size(); ++i)
            path.bring(static_cast<int>(i), dirac_light(scene, static_cast<int>(i), here.position, phase,
                                                        path.wavelengths, medium, statistics) *
                                                state.weight * (1 / mean(state.reach)));
        ray = {here.position, phase.sample(path.sampler.next2())};
        return bounce < 3 || survives<true>(state, path.sampler.next());
    }

    // What a light without extent brings to a scattering in a medium.
    static Radiance dirac_light(Scene const& scene, int index, Vector const& from, HenyeyGreenstein const& phase,
                                Wavelengths const& wavelengths, Medium const& medium, RayStatistics& statistics) {
        auto const light = scene.lights.light(index).sample(from, wavelengths, {0.5f, 0.5f});
        if (!light || light->density) return {};
        if (scene.accelerator->occluded(shadow_ray(from, light->wi, light->distance), statistics)) return {};
        return medium.transmittance(light->distance, wavelengths) * light->radiance * phase.density(light->wi).value;
    }

    static Radiance dirac_light(Scene const& scene, int index, Hit const& hit, Interaction const& here,
                                Wavelengths const& wavelengths, PathState const& state, Surroundings const& in,
                                RayStatistics& statistics) {
        auto const light = scene.lights.light(index).sample(hit.point.position, wavelengths, {0.5f, 0.5f});
        if (!light || light->density) return {};
        Direction const wi = here.frame.to_local(light->wi);
        BsdfValue const f = here.bsdf.evaluate(here.wo, wi).value;
        if (is_black(f) || !here.is_consistent(light->wi, wi)) return {};
        if (scene.accelerator->occluded(spawn_shadow_ray(hit.point, light->wi, light->distance), statistics)) return {};
        Lanes const scattered(f.lane * std::abs(wi.z()));  // per steradian, times the light's Dirac steradian
        Throughput const let_through =
            behind(scene, hit, here, wi, in).medium().transmittance(light->distance, wavelengths);
        return state.weight * scattered * let_through * light->radiance * (1 / mean(state.reach));
    }

    int max_bounces_;
    bool scattering_;
    std::optional<Surroundings> camera_in_;  // absent: to be found for each path
};

}  // namespace

std::unique_ptr<Integrator> make_reference_path(Scene const&, RenderPlan const& plan, IntegratorOptions&) {
    return std::make_unique<ReferencePath>(plan);
}

}  // namespace iride
