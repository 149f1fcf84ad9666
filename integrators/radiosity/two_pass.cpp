// SPDX-License-Identifier: Apache-2.0
#include "integrators/radiosity/two_pass.h"

#include "integrators/arrival.h"
#include "integrators/direct_light.h"

namespace iride::radiosity {

namespace {

constexpr int roulette_from = 2;  // scatterings before a chain of mirrors may end by chance

class TwoPass final : public Integrator {
  public:
    TwoPass(Scene const& scene, RenderPlan const& plan, std::shared_ptr<RadiosityField const> reflected,
            TwoPassSettings const& settings)
        : known_(std::move(reflected)),
          settings_(settings),
          selector_(scene.lights, plan.light_selection),
          light_sampling_(plan.light_sampling),
          max_bounces_(plan.max_bounces.value_or(longest_path)),
          camera_in_(plan.media ? plan.camera_in : Surroundings()) {}

    void follow(Scene const& scene, std::span<CameraPath> paths, RayStatistics& statistics) const override {
        for (CameraPath& path : paths) follow_one(scene, path, statistics);
    }
    bool may_be_negative() const override { return true; }

  private:
    void follow_one(Scene const& scene, CameraPath& path, RayStatistics& statistics) const {
        Wavelengths const& wavelengths = path.wavelengths;
        Ray ray = path.ray;
        Surroundings in = camera_in_ ? *camera_in_ : surroundings_at(scene, ray.origin);
        PathState state;
        Arrival arrival;
        bool first = true;  // no scattering other than by Dirac lobes so far
        for (int bounce = 0;; ++bounce) {
            std::optional<Hit> hit;
            auto const meet = [&](Hit const* met) {
                path.radiance += lamps_met(scene, ray, met, wavelengths, state, arrival, [&](int light) {
                    return light_sampling_ ? selector_.probability(arrival.from, light) : 0;
                });
            };
            if (!reach_surface(scene, wavelengths, ray, in, state.weight, hit, statistics, [&](Hit const& passed) {
                    meet(&passed);
                    arrival.density.reset();  // shadow rays end there
                }))
                return void(path.complete = false);
            meet(hit ? &*hit : nullptr);
            if (!hit) return;
            if (bounce >= max_bounces_) return void(path.complete = max_bounces_ < longest_path);

            Sampler& sampler = path.sampler;
            sampler.begin_vertex(static_cast<std::uint32_t>(bounce));
            Sample2 const choices = sampler.next2(), place = sampler.next2(), direction = sampler.next2(),
                          chances = sampler.next2();
            describe_meeting(hit->point, -ray.direction, chances.y);
            Interaction const here(scene, *hit, -ray.direction, wavelengths, &in);
            bool const dense = here.bsdf.has_density(), gathers = dense && first;
            float const share = gathers ? settings_.go_on : 1;
            DirectVertex const vertex{scene, *hit, here, wavelengths, state, in};
            if (dense && light_sampling_) path.radiance += from_lamps(vertex, choices.x, place, share, statistics);
            if (gathers) path.radiance += gathered_from_patches(vertex, sampler.next2(), sampler.next(), statistics);

            auto const sample = here.bsdf.sample(here.wo, {choices.y, direction});
            if (!sample) return;
            Direction const wi = here.frame.to_world(sample->wi);
            if (!here.is_consistent(wi, sample->wi)) return;
            arrival = {sample->density, receiver(scene, *hit, here.geometric_normal), mean(state.reach)};
            state.weight *= sample->weight;
            state.reach *= sample->reach;
            in = behind(scene, *hit, here, sample->wi, in);
            ray = spawn_ray(hit->point, wi);
            if (!dense) {
                if (bounce >= roulette_from && !survives<true>(state, chances.x)) return;
                continue;
            }
            Radiance known;
            if (sample->density) known = state.weight * seen(ray, wavelengths, statistics) * (1 / mean(state.reach));
            // Not below the share of light that is kept: else the variance of a wrong solution might be infinite.
            float const q = gathers ? share : std::min(1.0f, largest(sample->weight).value);
            if (!gathers) path.radiance += known;
            if (!(chances.x < q)) return;
            path.radiance -= known * (1 / q);
            state.weight /= q;
            if (arrival.density) arrival.density->value *= share;
            first = false;
        }
    }

    // Reflected radiance of the patch that a ray meets.
    Radiance seen(Ray const& ray, Wavelengths const& wavelengths, RayStatistics& statistics) const {
        ++statistics.closest_rays;
        auto const met = known_->tracer().closest(ray);
        return met ? known_->radiance(*met, wavelengths) : Radiance{};
    }

    // The integral of f |cos| R along the path: directions of the BSDF, their numbers points of a shifted lattice.
    Radiance gathered_from_patches(DirectVertex const& v, Sample2 shift, float lobe, RayStatistics& statistics) const {
        constexpr float a = 0.7548777f, b = 0.5698403f;  // 1/g, 1/g^2 with g^3 = g + 1: even in the plane
        auto const turned = [](float x) { return x - std::floor(x); };
        Radiance sum;
        for (int k = 0; k < settings_.rays; ++k) {
            auto const i = static_cast<float>(k);
            auto const sample = v.here.bsdf.sample(v.here.wo, {turned(lobe + i / static_cast<float>(settings_.rays)),
                                                               {turned(shift.x + a * i), turned(shift.y + b * i)}});
            if (!sample || !sample->density) continue;
            Direction const wi = v.here.frame.to_world(sample->wi);
            if (!v.here.is_consistent(wi, sample->wi)) continue;
            sum += v.state.weight * sample->weight * seen(spawn_ray(v.hit.point, wi), v.wavelengths, statistics) *
                   (1 / mean(v.state.reach * sample->reach));
        }
        return sum * (1 / static_cast<float>(settings_.rays));
    }

    Radiance from_lamps(DirectVertex const& v, float which, Sample2 place, float share,
                        RayStatistics& statistics) const {
        auto const choice = selector_.choose(receiver(v.scene, v.hit, v.here.geometric_normal), which);
        if (choice.light < 0) return {};
        auto const light = v.scene.lights.light(choice.light).sample(v.hit.point.position, v.wavelengths, place);
        if (!light) return {};
        return from_lamp(
            v, *light, choice.probability, [&](LaneDensity const&, float) { return share; }, statistics);
    }

    std::shared_ptr<RadiosityField const> known_;
    TwoPassSettings settings_;
    LightSelector selector_;
    bool light_sampling_;
    int max_bounces_;
    std::optional<Surroundings> camera_in_;  // absent: to be found for each path
};

}  // namespace

std::unique_ptr<Integrator> two_pass(Scene const& scene, RenderPlan const& plan,
                                     std::shared_ptr<RadiosityField const> reflected, TwoPassSettings const& settings) {
    return std::make_unique<TwoPass>(scene, plan, std::move(reflected), settings);
}

std::unique_ptr<Integrator> make_two_pass(Scene const& scene, RenderPlan const& plan, IntegratorOptions& options) {
    Settings solution{.fineness = 256};
    TwoPassSettings settings;
    solution.patches = options.integer("patches", 1, 1000000, solution.patches);
    settings.rays = options.integer("rays", 1, 1024, settings.rays);
    settings.go_on = static_cast<float>(
        options.number("go_on", {.least = 0, .most = 1, .least_excluded = true}, static_cast<double>(settings.go_on)));
    options.finish();
    SceneRadiosity const known(scene, plan.wavelengths, solution);
    return two_pass(scene, plan, known.field_of(known.reflected()), settings);
}

}  // namespace iride::radiosity
