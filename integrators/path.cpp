// SPDX-License-Identifier: Apache-2.0
#include "integrators/path.h"

#include "integrators/scattering.h"

namespace iride {

namespace {

constexpr int roulette_from = 2;  // scatterings before paths may end by chance

template <bool Dispersive>
class Path final : public Integrator {
  public:
    explicit Path(RenderPlan const& plan)
        : max_bounces_(plan.max_bounces.value_or(longest_path)),
          light_sampling_(plan.light_sampling),
          environment_(plan.environment) {}

    PathResult radiance(Scene const& scene, Ray ray, Wavelengths const& wavelengths, Sampler& sampler,
                        RayStatistics& statistics) const override {
        Radiance L;
        PathState state;
        Arrival arrival;
        for (int bounce = 0;; ++bounce) {
            std::optional<Hit> const hit = scene.accelerator->closest(ray, statistics);
            if (!hit) {
                if (environment_) L += from_environment(scene, ray.direction, wavelengths, state, arrival);
                return {L};
            }
            if (hit->shape->light >= 0) L += from_emitter(scene, *hit, ray, wavelengths, state, arrival);
            if (bounce >= max_bounces_) return {L, max_bounces_ < longest_path};

            sampler.begin_vertex(static_cast<std::uint32_t>(bounce));
            VertexNumbers const u(sampler);
            Interaction const here(scene, *hit, -ray.direction, wavelengths);
            // The light sample and the next direction are both drawn before anything is traced: each is a long chain of
            // dependent arithmetic, and the processor works on the two side by side.
            std::optional<Unshadowed> direct;
            if (light_sampling_ && here.bsdf.has_density())
                direct = from_light_sample(scene, *hit, here, wavelengths, state, u);
            bool const scattered = scatter(*hit, here, u, state, arrival, ray);
            if (direct && !scene.accelerator->occluded(direct->shadow_ray, statistics)) L += direct->radiance;
            if (!scattered) return {L};
            if (bounce >= roulette_from && !survives<Dispersive>(state, u.roulette.x)) return {L};
        }
    }

  private:
    // The decisions at a vertex, a block of the sampler.
    struct VertexNumbers {
        explicit VertexNumbers(Sampler& s)
            : choices(s.next2()), light(s.next2()), direction(s.next2()), roulette(s.next2()) {}
        Sample2 choices;  // x: which light, y: which lobe
        Sample2 light, direction, roulette;
    };

    // How the ray at hand was chosen: what light sampling from there would have had to compete with.
    struct Arrival {
        std::optional<PerSteradian> density;  // p_hero; absent from the camera and after a Dirac lobe
        Vector from{0, 0, 0};
        float mean_reach_before = 1;
    };

    // mean(next.reach) + mean(state.reach) p_light / p_hero.
    static float mixture(PathState const& next, Arrival const& arrival, float light_density) {
        float const reach = Dispersive ? float(mean(next.reach)) : 1.0f;
        if (!arrival.density) return reach;
        return reach + arrival.mean_reach_before * light_density / arrival.density->value;
    }

    float choice_density(Scene const& scene, int light) const {
        return light_sampling_ ? scene.lights.probability(light) : 0;
    }

    Radiance from_environment(Scene const& scene, Direction const& wi, Wavelengths const& wavelengths,
                              PathState const& state, Arrival const& arrival) const {
        Radiance L;
        for (int e : scene.lights.environments()) {
            Light const& light = scene.lights.light(e);
            float const p = arrival.density ? choice_density(scene, e) * light.arriving_density(wi).value : 0;
            L += state.weight * light.arriving(wi, wavelengths) * (1 / mixture(state, arrival, p));
        }
        return L;
    }

    Radiance from_emitter(Scene const& scene, Hit const& hit, Ray const& ray, Wavelengths const& wavelengths,
                          PathState const& state, Arrival const& arrival) const {
        Light const& light = scene.lights.light(hit.shape->light);
        Radiance const Le = light.emitted(hit.point, -ray.direction, wavelengths);
        if (is_black(Le)) return {};
        float p = 0;
        if (arrival.density)
            p = choice_density(scene, hit.shape->light) * light.density(arrival.from, hit.point, hit.primitive).value;
        return state.weight * Le * (1 / mixture(state, arrival, p));
    }

    // What a light sample brings if nothing stands between.
    struct Unshadowed {
        Radiance radiance;
        Ray shadow_ray;
    };

    static std::optional<Unshadowed> from_light_sample(Scene const& scene, Hit const& hit, Interaction const& here,
                                                       Wavelengths const& wavelengths, PathState const& state,
                                                       VertexNumbers const& u) {
        auto const choice = scene.lights.choose(u.choices.x);
        if (!choice) return {};
        auto const light = scene.lights.light(choice->index).sample(hit.point.position, wavelengths, u.light);
        if (!light) return {};
        Direction const wi = here.frame.to_local(light->wi);
        BsdfEvaluation const f = here.bsdf.evaluate(here.wo, wi);
        if (is_black(f.value) || !here.is_consistent(light->wi, wi)) return {};
        // In units of a steradian: a density for lights of extent, the Dirac's own measure for the others.
        float const cosine = std::abs(wi.z());
        Lanes competitors;
        if (light->density)
            competitors = Lanes(f.density.lane + choice->probability * light->density->value);
        else
            competitors = Lanes(choice->probability);
        float const divisor = Dispersive ? float(mean(state.reach * competitors)) : competitors[0];
        Lanes const scattered(f.value.lane * (cosine / divisor));
        return Unshadowed{state.weight * scattered * light->radiance,
                          spawn_shadow_ray(hit.point, light->wi, light->distance)};
    }

    static bool scatter(Hit const& hit, Interaction const& here, VertexNumbers const& u, PathState& state,
                        Arrival& arrival, Ray& ray) {
        auto const sample = here.bsdf.sample(here.wo, {u.choices.y, u.direction});
        if (!sample) return false;
        Direction const wi = here.frame.to_world(sample->wi);
        if (!here.is_consistent(wi, sample->wi)) return false;
        if constexpr (Dispersive) {
            arrival.mean_reach_before = mean(state.reach);
            state.reach *= sample->reach;
        }
        state.weight *= sample->weight;
        arrival.density = sample->density;
        arrival.from = hit.point.position;
        ray = spawn_ray(hit.point, wi);
        return true;
    }

    int max_bounces_;
    bool light_sampling_, environment_;
};

}  // namespace

std::unique_ptr<Integrator> make_path(RenderPlan const& plan) {
    if (plan.dispersion) return std::make_unique<Path<true>>(plan);
    return std::make_unique<Path<false>>(plan);
}

}  // namespace iride
