// SPDX-License-Identifier: Apache-2.0
#include "integrators/bidirectional.h"

#include "integrators/light_tracing.h"
#include "integrators/light_walk.h"

namespace iride {

namespace {

constexpr int roulette_from = 2;  // scatterings before camera paths may end by chance

// What arrives if nothing stands between: contributions of one camera path, their rays traced together.
class Shadowed {
  public:
    void clear() { radiance_.clear(), queries_.clear(); }
    void add(Radiance const& radiance, Ray const& ray) {
        radiance_.push_back(radiance);
        queries_.push_back({ray});
    }
    Radiance traced(Scene const& scene, RayStatistics& statistics) {
        scene.accelerator->occluded(queries_, statistics);
        Radiance sum;
        for (std::size_t i = 0; i < queries_.size(); ++i)
            if (!queries_[i].occluded) sum += radiance_[i];
        return sum;
    }

  private:
    std::vector<Radiance> radiance_;
    std::vector<ShadowQuery> queries_;
};

template <class Heuristic>
class Bidirectional final : public Integrator {
  public:
    Bidirectional(Scene const& scene, RenderPlan const& plan)
        : context_(scene, plan), media_(plan.media), camera_in_(plan.camera_in) {}

    void follow(Scene const& scene, std::span<CameraPath> paths, RayStatistics& statistics) const override {
        Work work;
        LightWalk<Heuristic> light_walk;
        Sightings sightings;
        for (CameraPath& path : paths) {
            work.vertices.clear();
            work.shadowed.clear();
            walk_from_lights<Heuristic>(
                scene, context_, emission_, {&path, 1}, {&light_walk, 1}, statistics,
                [](CameraPath&, LightStart const&, Sample2) {},
                [&](CameraPath&, LightVertex<Heuristic> const& here, Flux const& flux, Sample2 lens) {
                    work.flux = flux;
                    work.vertices.push_back(here);
                    sightings.add(path, send_to_camera(scene, context_, path.wavelengths, here, flux, lens, true),
                                  scene, statistics);
                });
            walk_from_camera(scene, path, work, statistics);
            path.radiance += work.shadowed.traced(scene, statistics);
        }
        sightings.trace(scene, statistics);
    }
    bool splats() const override { return true; }

  private:
    struct Work {
        std::vector<LightVertex<Heuristic>> vertices;
        Flux flux;
        Shadowed shadowed;
    };

    void walk_from_camera(Scene const& scene, CameraPath& path, Work& work, RayStatistics& statistics) const {
        Subpath<Heuristic> walk;
        std::optional<Surroundings> in;
        if (media_) in = camera_in_ ? *camera_in_ : surroundings_at(scene, path.ray.origin);
        for (int bounce = 0;; ++bounce) {
            Vector const from = path.ray.origin;
            bool joined = true;
            Way const way =
                follow_to_surface(scene, path.wavelengths, path.ray, in, walk, statistics, [&](Hit const& passed) {
                    path.radiance += from_lamp(scene, path, from, passed, walk, bounce);
                    joined = false;
                });
            if (!way.complete) return void(path.complete = false);
            auto const& hit = way.hit;
            if (!hit) return void(path.radiance += from_infinity(scene, path, walk));
            Direction const back = -path.ray.direction;
            float const arriving = std::abs(back.dot(hit->point.geometric_normal));
            if (!(arriving > 0)) return;
            path.radiance += from_lamp(scene, path, from, *hit, walk, bounce);
            if (bounce == context_.max_bounces) {
                path.complete &= context_.max_bounces < longest_path;
                return;
            }
            if (bounce == 0)
                walk.near = Lanes(joined ? Heuristic::of(context_.light_paths() /
                                                         (context_.camera.density(path.ray, way.length) * arriving))
                                         : 0);
            else
                walk.arrive(way.length, arriving);
            path.sampler.begin_vertex(static_cast<std::uint32_t>(bounce));
            Sample2 const choices = path.sampler.next2(), on_light = path.sampler.next2(), on = path.sampler.next2(),
                          chances = path.sampler.next2();
            Meeting const here(scene, *hit, back, path.wavelengths, chances.y, in);
            if (here.seen().bsdf.has_density()) {
                sample_light(scene, path, here, walk, {choices.x, on_light}, work.shadowed);
                for (LightVertex<Heuristic> const& vertex : work.vertices) {
                    if (bounce + 1 + vertex.number > context_.max_bounces) break;
                    join(scene, path.wavelengths, here, walk, vertex, work);
                }
            }
            if (!scatter(scene, path, here, {choices.y, on}, walk)) return;
            in = here.beside(scene, path.ray.direction);
            if (bounce >= roulette_from && !survives<true>(walk.state, chances.x)) return;
        }
    }

    // With which a vertex asks this light: by power alone, wherever it is.
    float asked(int light) const { return context_.selector.probability({}, light); }

    // s = 0: `near` and `far` as they are before the last ray's end.
    Radiance from_lamp(Scene const& scene, CameraPath const& path, Vector const& from, Hit const& hit,
                       Subpath<Heuristic> const& walk, int bounce) const {
        int const index = hit.shape->light;
        if (index < 0) return {};
        Light const& light = scene.lights.light(index);
        Direction const travel = -path.ray.direction;
        Radiance const Le = light.emitted(hit.point, travel, path.wavelengths);
        if (is_black(Le)) return {};
        Lanes techniques = Heuristic::of(walk.state.reach);
        if (bounce > 0) {
            float const cosine = travel.dot(hit.point.geometric_normal);
            float const sampled = asked(index) * light.density(from, hit.point, hit.primitive).value;
            float const emitted = emission_.density(scene, context_.ball, index, hit.point.position, travel, cosine);
            techniques += Heuristic::of(sampled) * walk.near + Heuristic::of(emitted / std::abs(cosine)) * walk.far;
        }
        return walk.state.weight * Le * (1 / float(mean(techniques)));
    }
    Radiance from_infinity(Scene const& scene, CameraPath const& path, Subpath<Heuristic> const& walk) const {
        Radiance L;
        Direction const wi = path.ray.direction;
        for (int e : scene.lights.environments()) {
            Light const& light = scene.lights.light(e);
            Lanes const techniques =
                Heuristic::of(walk.state.reach) +
                Heuristic::of(asked(e) * light.arriving_density(wi).value) * walk.near +
                Heuristic::of(emission_.density(scene, context_.ball, e, path.ray.origin, -wi, 1)) * walk.far;
            L += walk.state.weight * light.arriving(wi, path.wavelengths) * (1 / float(mean(techniques)));
        }
        return L;
    }

    // s = 1.
    void sample_light(Scene const& scene, CameraPath const& path, Meeting const& here, Subpath<Heuristic> const& walk,
                      Sample3 u, Shadowed& shadowed) const {
        auto const choice = context_.selector.choose({}, u.lobe);
        if (choice.light < 0) return;
        Light const& light = scene.lights.light(choice.light);
        auto const sample = light.sample(here.point().position, path.wavelengths, u.direction);
        if (!sample) return;
        Scattering const s = here.scattering(scene, path.wavelengths, here.back(), sample->wi);
        if (is_black(s.value)) return;
        float const chosen = choice.probability * (sample->density ? sample->density->value : 1);
        // The density over area here of the light's own paths, over that of this sample.
        float p_back =
            here.cosine(sample->wi) / (chosen * sample->cosine) *
            emission_.density(scene, context_.ball, choice.light, here.point().position + sample->distance * sample->wi,
                              -sample->wi, sample->cosine);
        if (light.extent() == LightExtent::point) p_back /= square(sample->distance);
        Lanes techniques = Heuristic::of(walk.state.reach);
        if (p_back > 0)
            techniques +=
                walk.others(Lanes(p_back), [&] { return here.density_back(scene, path.wavelengths, sample->wi); });
        if (sample->density) techniques += Heuristic::of(walk.state.reach * Lanes(s.density.lane) / chosen);
        float const scale = s.cosine / (chosen * float(mean(techniques)));
        Throughput const let_through = here.let_through(scene, path.wavelengths, sample->wi, sample->distance);
        shadowed.add(walk.state.weight * let_through * Throughput(s.value.lane * scale) * sample->radiance,
                     spawn_shadow_ray(here.point(), sample->wi, sample->distance));
    }

    // A camera vertex with a light vertex.
    void join(Scene const& scene, Wavelengths const& wavelengths, Meeting const& here, Subpath<Heuristic> const& walk,
              LightVertex<Heuristic> const& vertex, Work& work) const {
        Meeting const& there = vertex.meeting;
        Vector const d = there.point().position - here.point().position;
        float const distance2 = d.squaredNorm();
        if (!(distance2 > 0)) return;
        float const distance = std::sqrt(distance2);
        Direction const towards = d / distance;
        Scattering const f = here.scattering(scene, wavelengths, here.back(), towards);
        if (is_black(f.value)) return;
        Scattering const g = there.scattering(scene, wavelengths, -towards, there.back());
        if (is_black(g.value)) return;
        Scattering const g_on = there.scattering(scene, wavelengths, there.back(), -towards);
        Lanes const p_there = Lanes(f.density.lane) * (there.cosine(towards) / distance2),
                    p_here = Lanes(g_on.density.lane) * (here.cosine(towards) / distance2);
        Lanes const here_reach = Heuristic::of(walk.state.reach), there_reach = Heuristic::of(vertex.path.state.reach);
        Lanes const techniques = here_reach * there_reach + here_reach * vertex.path.others(p_there, [&] {
            return Lanes(g.density.lane);
        }) + there_reach * walk.others(p_here, [&] { return here.density_back(scene, wavelengths, towards); });
        float const scale =
            f.cosine * there.adjoint_cosine(g.cosine, there.back(), towards) / (distance2 * float(mean(techniques)));
        Radiance const joined(work.flux.lane * vertex.path.state.weight.lane * g.value.lane * f.value.lane * scale);
        Throughput const let_through = here.let_through(scene, wavelengths, towards, distance);
        work.shadowed.add(walk.state.weight * let_through * joined, spawn_shadow_ray(here.point(), towards, distance));
    }

    bool scatter(Scene const& scene, CameraPath& path, Meeting const& here, Sample3 u, Subpath<Heuristic>& walk) const {
        Interaction const& seen = here.seen();
        auto const sample = seen.bsdf.sample(seen.wo, u);
        if (!sample) return false;
        Direction const on = seen.frame.to_world(sample->wi);
        if (!seen.is_consistent(on, sample->wi)) return false;
        if (sample->density) {
            walk.go_on(here, *sample, on, [&] { return here.density_back(scene, path.wavelengths, on); });
        } else {
            walk.go_on_through_dirac(here, *sample, here.squared_index_ratio(scene, path.wavelengths, on));
            if (!here.is_framed_alike(scene, path.wavelengths, on)) walk.far = Lanes();  // no light path comes this way
        }
        walk.state.weight *= sample->weight;
        path.ray = spawn_ray(here.point(), on);
        return true;
    }

    TwoWayContext context_;
    LampEmission emission_;
    bool media_;
    std::optional<Surroundings> camera_in_;  // absent: to be found for each path
};

}  // namespace

std::unique_ptr<Integrator> make_bidirectional(Scene const& scene, RenderPlan const& plan, IntegratorOptions&) {
    check_light_paths_possible(scene, plan, "bidirectional");
    return std::make_unique<Bidirectional<BalanceHeuristic>>(scene, plan);
}
std::unique_ptr<Integrator> make_bidirectional_power(Scene const& scene, RenderPlan const& plan, IntegratorOptions&) {
    check_light_paths_possible(scene, plan, "bidirectional-power");
    return std::make_unique<Bidirectional<PowerHeuristic>>(scene, plan);
}

}  // namespace iride
