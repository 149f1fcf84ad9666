// SPDX-License-Identifier: Apache-2.0
#include "integrators/path.h"

#include <algorithm>
#include <array>

#include "integrators/light_afloat.h"
#include "integrators/radiosity/field.h"
#include "integrators/shared_vertices.h"
#include "integrators/splits.h"

namespace iride {

namespace {

constexpr int roulette_from = 2;       // scatterings before paths may end by chance
constexpr std::size_t most_lamps = 3;  // that are asked all at once
constexpr int most_splits = 64;

// The paths of a batch go on together, stage by stage: within a stage they are independent of one another, and the
// processor works on several of their long chains of dependent arithmetic at a time.
// Lit: light paths aimed at mirrors and glass go with them.
template <bool Dispersive, bool Media, bool Scattering = false, bool Lit = false>
class Path final : public Integrator {
    using LightPaths = std::conditional_t<Lit, AimedLightPaths, NotCarried>;

  public:
    Path(Scene const& scene, RenderPlan const& plan, PathHabits const& habits, KnownIndirect known,
         LightPaths light_paths = {})
        : light_paths_(std::move(light_paths)),
          known_(std::move(known)),
          selector_(scene.lights, plan.light_selection, plan.uniform_light),
          light_afloat_(scene, plan, selector_),
          max_bounces_(plan.max_bounces.value_or(longest_path)),
          light_sampling_(plan.light_sampling && !selector_.none()),
          environment_(plan.environment),
          ray_cones_(plan.ray_cones),
          shares_(habits.share && !Scattering && !ray_cones_ && !plan.whole_paths),
          camera_in_(plan.camera_in) {
        if (habits.splits > 1) pilot_.emplace(plan, habits.splits);
    }

    std::vector<std::string> remarks() const override { return known_.remarks; }
    bool splats() const override { return Lit; }
    int block_side() const override { return shares_ ? widest_block : 1; }
    int samples_alike(std::uint32_t first) const override {
        return pilot_ ? pilot_->samples_alike(first) : Integrator::samples_alike(first);
    }
    std::uint32_t weight() const override { return pilot_ ? pilot_->weight() : 1; }
    void prepare(Scene const& scene, SamplePass const& pass, RayStatistics& statistics) override {
        if (!pilot_ || !pilot_->is_due(pass.last - 1)) return;
        splits_ = {};
        LightPathsBeside beside;
        if constexpr (Lit) beside = light_paths_.in_pilot(scene);
        auto const camera = std::bind_front(&Path::follow_from_camera, this, std::cref(scene));
        LearntSplits learnt = pilot_->learn(scene, pass.last - 1, camera, beside, statistics);
        splits_ = std::move(learnt.splits);
        if constexpr (Lit) light_paths_.set_share(learnt.light_paths);
    }

    void follow(Scene const& scene, std::span<CameraPath> paths, RayStatistics& statistics) const override {
        follow_from_camera(scene, paths, statistics);
        if constexpr (Lit) light_paths_.follow(scene, paths, splits_, statistics);
    }

  private:
    static_assert(!Scattering || (Dispersive && Media), "flights leave each lane its own reach");
    static_assert(!Scattering || !Lit, "light paths know no medium that scatters");
    using Walk = iride::Walk<Media, Scattering, Lit>;
    using Met = std::conditional_t<Lit, Meeting, Interaction>;
    using Walks = std::array<Walk, batch_size>;

    // Neighbours leave the camera together; after a scattering each goes its own way.
    static Accelerator::Coherence coherence(int bounce) {
        return bounce == 0 ? Accelerator::Coherence::close : Accelerator::Coherence::none;
    }
    void follow_from_camera(Scene const& scene, std::span<CameraPath> paths, RayStatistics& statistics) const {
        Walks walks;
        Exchange between;
        Alive alive(paths.size());
        if constexpr (Media)
            for (std::size_t i = 0; i < paths.size(); ++i)
                walks[i].in = camera_in_ ? *camera_in_ : surroundings_at(scene, paths[i].ray.origin);
        if (ray_cones_)
            for (std::size_t i = 0; i < paths.size(); ++i) walks[i].cone = paths[i].cone;
        reach_vertex(scene, paths, walks, alive, 0, between, statistics);
        if (splits_.none() && !shares_)
            go_on(scene, paths, walks, alive, between, statistics);
        else
            go_on_in_parts(scene, paths, walks, alive, between, statistics);
    }

    // The ends of the paths' rays: those that remain alive are at vertex `bounce`.
    [[gnu::flatten]] void reach_vertex(Scene const& scene, std::span<CameraPath> paths, Walks& walks, Alive& alive,
                                       int bounce, Exchange& between, RayStatistics& statistics) const {
        alive.for_each(
            [&](std::size_t i) { walks[i].begin_vertex(paths[i].sampler, static_cast<std::uint32_t>(bounce)); });
        find_hits(scene, paths, walks, alive, coherence(bounce), between.queries, statistics);
        if constexpr (Media)
            alive.keep_if([&](std::size_t i) {
                return travel_on(scene, paths[i], walks[i], bounce, between.shadows, statistics);
            });
        if constexpr (Scattering) between.shadows.trace(scene, statistics);
        alive.keep_if([&](std::size_t i) { return arrive(scene, paths[i], walks[i], bounce); });
    }

    // From the first vertex to the end.
    void go_on(Scene const& scene, std::span<CameraPath> paths, Walks& walks, Alive& alive, Exchange& between,
               RayStatistics& statistics, SharedVertices<Walk>* shared = nullptr) const {
        for (int bounce = 0; !alive.none();) {
            if (shared && bounce == 1) shared->begin(scene, alive, statistics);
            if (known_.field) {
                bring_known(scene, paths, walks, alive, bounce, statistics);
                if (light_sampling_ && scene.lights.size() <= most_lamps) {
                    light_by_all(scene, paths, walks, alive, between, statistics);
                    alive.keep_if([&](std::size_t i) { return !is_diffuse(scene, walks[i]); });
                }
            }
            if (light_sampling_) ask_lights(scene, paths, walks, alive, between);
            alive.keep_if([&](std::size_t i) {
                return scatter(scene, paths[i], walks[i], bounce, between.shadows, statistics) &&
                       (bounce < roulette_from ||
                        survives<Dispersive>(walks[i].state, walks[i].numbers.chances.x, chance_to_return(walks[i])));
            });
            if (light_sampling_) between.shadows.trace(scene, statistics);
            reach_vertex(scene, paths, walks, alive, ++bounce, between, statistics);
        }
    }

    // Each path from its first vertex, in parts.
    void go_on_in_parts(Scene const& scene, std::span<CameraPath> paths, Walks& walks, Alive const& alive,
                        Exchange& between, RayStatistics& statistics) const {
        Parts<Walk> parts(paths);
        std::optional<SharedVertices<Walk>> shared;
        if (shares_) shared.emplace(first_vertices(scene, paths, walks, alive), parts);
        auto const finish = [&] {
            Alive all(parts.size());
            go_on(scene, parts.paths(), parts.walks(), all, between, statistics, shared ? &*shared : nullptr);
            if (shared) shared->end();
            parts.gather();
        };
        alive.for_each([&](std::size_t i) {
            std::uint32_t const of_path = splits_.at(paths[i].x, paths[i].y);
            for (std::uint32_t k = 0; k < of_path; ++k) {
                parts.add(i, walks[i], k, of_path);
                if (parts.size() == batch_size) finish();
            }
        });
        finish();
        if (shared) shared->bring(paths);
    }

    // From which the paths of a block may share what they find.
    FirstVertices first_vertices(Scene const& scene, std::span<CameraPath const> paths, Walks& walks,
                                 Alive const& alive) const {
        FirstVertices first(paths);
        alive.for_each([&](std::size_t i) {
            Walk& walk = walks[i];
            if (!is_lambertian(scene, walk)) return;
            if constexpr (Media)
                if (walk.in.medium().attenuates()) return;
            float rivals = 0;
            if constexpr (Lit) {
                rivals = walk.rivalry.near[0];
                if (rivals != 0 && !is_flat(walk.hit.point)) return;
            }
            Met const met = meeting(scene, paths[i], walk);
            first.add(i, walk.hit.point, seen(met), static_cast<float>(splits_.at(paths[i].x, paths[i].y)), rivals);
        });
        return first;
    }

    // Through surfaces that are none to the first that is one, or to a scattering; false if there is no end to them.
    bool travel_on(Scene const& scene, CameraPath& path, Walk& walk, [[maybe_unused]] int bounce,
                   [[maybe_unused]] Shadows& shadows, RayStatistics& statistics) const {
        Flight flight(walk.flight_depth());
        if constexpr (Scattering) walk.floating.at.reset();
        for (int passed = 0;; ++passed) {
            if constexpr (Scattering)
                if (light_sampling_ && bounce < max_bounces_)
                    light_afloat_.look_along(scene, path, walk, shadows, statistics);
            if (!travel_once(scene, path, walk, flight)) return true;
            if (walk.hit.shape->light >= 0) path.bring(walk.hit.shape->light, from_emitter(scene, path, walk));
            walk.arrival.density.reset();  // shadow rays end here: no sample of a lamp or a beam gets further
            if constexpr (Lit) walk.rivalry.pass(walk.hit.distance);
            if (passed == longest_path) return path.complete = false;
            ClosestQuery query{&path.ray, &walk.hit};
            scene.accelerator->closest({&query, 1}, Accelerator::Coherence::none, statistics);
            walk.has_hit = query.found;
        }
    }
    float chance_to_return([[maybe_unused]] Walk& walk) const {
        if constexpr (Scattering) return light_afloat_.chance_to_return(walk);
        return 1;
    }

    float choice_density(Arrival const& arrival, int light) const {
        return light_sampling_ ? selector_.probability(arrival.from, light) : 0;
    }

    LightReceiver receiver_of(Scene const& scene, Direction const& to_viewer, Walk const& walk) const {
        if (!selector_.looks_at_receiver() || walk.is_afloat()) return {walk.place(), Vector(0, 0, 0)};
        return receiver(scene, walk.hit, walk.side_of(to_viewer));
    }

    // What is emitted where the ray ends, and the surface there; false if the path ends with it.
    bool arrive(Scene const& scene, CameraPath& path, Walk& walk, int bounce) const {
        if (walk.is_afloat()) {
            if (bounce >= max_bounces_) path.complete = max_bounces_ < longest_path;
            return bounce < max_bounces_;
        }
        if (!walk.has_hit) {
            if (environment_) bring_environment(scene, path, walk);
            return false;
        }
        if (walk.hit.shape->light >= 0) path.bring(walk.hit.shape->light, from_emitter(scene, path, walk));
        if (walk.light_is_known) return false;
        if (bounce >= max_bounces_) {
            path.complete = max_bounces_ < longest_path;
            return false;
        }
        if constexpr (Lit) return arrive_beside_light_paths(path, walk, bounce);
        return true;
    }

    bool arrive_beside_light_paths(CameraPath const& path, Walk& walk, int bounce) const {
        float const arriving = std::abs(path.ray.direction.dot(walk.hit.point.geometric_normal));
        if (bounce > 0)
            walk.rivalry.arrive(walk.rivalry.passed + walk.hit.distance, arriving);
        else if (walk.rivalry.passed == 0)
            walk.rivalry.near = Lanes(
                BesideLightPaths::shown(light_paths_.per_camera_path(path, splits_, walk.hit.distance) / arriving));
        return arriving > 0;
    }

    void bring_environment(Scene const& scene, CameraPath& path, Walk const& walk) const {
        Direction const wi = path.ray.direction;
        for (int e : scene.lights.environments()) {
            Light const& light = scene.lights.light(e);
            float const p =
                walk.arrival.density ? choice_density(walk.arrival, e) * light.arriving_density(wi).value : 0;
            path.bring(e,
                       walk.state.weight * light.arriving(wi, path.wavelengths) * (1 / mixture<Dispersive>(walk, p)));
        }
    }

    Radiance from_emitter(Scene const& scene, CameraPath const& path, Walk const& walk) const {
        Hit const& hit = walk.hit;
        Light const& light = scene.lights.light(hit.shape->light);
        Radiance const Le = light.emitted(hit.point, -path.ray.direction, path.wavelengths);
        if (is_black(Le)) return {};
        float p = 0;
        if (walk.arrival.density)
            p = choice_density(walk.arrival, hit.shape->light) *
                light.density(walk.arrival.from.position, hit.point, hit.primitive).value;
        float divisor = mixture<Dispersive>(walk, p);
        if constexpr (Lit)
            if (!is_black(walk.rivalry.far))
                divisor += float(mean(walk.rivalry.far)) * light_paths_.starting(scene, path.ray, hit);
        return walk.state.weight * Le * (1 / divisor);
    }

    // What the patches send out, in the directions of the paths, where these scatter next.
    void bring_known(Scene const& scene, std::span<CameraPath> paths, Walks const& walks, Alive const& alive,
                     int bounce, RayStatistics& statistics) const {
        std::array<radiosity::PatchQuery, batch_size> queries;
        std::array<std::size_t, batch_size> of;
        std::size_t count = 0;
        alive.for_each([&](std::size_t i) {
            if (walks[i].is_afloat() || !is_dense(scene, walks[i])) return;
            queries[count].ray = &paths[i].ray;
            of[count++] = i;
        });
        known_.field->tracer().closest(std::span(queries).first(count), coherence(bounce), statistics);
        for (std::size_t k = 0; k < count; ++k) {
            CameraPath& path = paths[of[k]];
            PathState const& state = walks[of[k]].state;
            Radiance const sent = known_.field->radiance(queries[k].hit, path.wavelengths);
            path.radiance += state.weight * sent * (1 / (Dispersive ? float(mean(state.reach)) : 1.0f));
        }
    }

    // Choose a light for each vertex that can use one; ask each light for all its samples at a time.
    void ask_lights(Scene const& scene, std::span<CameraPath const> paths, Walks& walks, Alive const& alive,
                    Exchange& between) const {
        std::size_t count = 0;
        alive.for_each([&](std::size_t i) {
            walks[i].light = nullptr;
            if (!walks[i].is_afloat() && !is_dense(scene, walks[i])) return;
            auto const choice =
                selector_.choose(receiver_of(scene, -paths[i].ray.direction, walks[i]), walks[i].numbers.choices.x);
            if (choice.light >= 0) between.asking[count++] = {i, choice};
        });
        std::span<Asking> const asking(between.asking.data(), count);
        if (scene.lights.size() > 1) std::ranges::sort(asking, {}, [](Asking const& a) { return a.choice.light; });
        auto& requests = between.requests;
        for (std::size_t k = 0; k < count; ++k) {
            std::size_t const i = asking[k].walk;
            requests[k].from = walks[i].place();
            requests[k].u = walks[i].numbers.light;
            requests[k].wavelengths = &paths[i].wavelengths;
        }
        answer(scene, asking, requests);
        for (std::size_t k = 0; k < count; ++k) {
            Walk& walk = walks[asking[k].walk];
            walk.light = requests[k].sample ? &*requests[k].sample : nullptr;
            walk.choice = asking[k].choice;
        }
    }

    // At diffuse surfaces where the rest is known: what every lamp brings. Nothing is left for the path to find.
    void light_by_all(Scene const& scene, std::span<CameraPath> paths, Walks& walks, Alive const& alive,
                      Exchange& between, RayStatistics& statistics) const {
        for (std::size_t lamp = 0; lamp < scene.lights.size(); ++lamp) {
            std::size_t count = 0;
            alive.for_each([&](std::size_t i) {
                if (!is_diffuse(scene, walks[i])) return;
                VertexNumbers const& numbers = walks[i].numbers;
                LightRequest& request = between.requests[count];
                request.from = walks[i].place();
                request.normal = walks[i].side_of(-paths[i].ray.direction);
                request.u = std::array{numbers.light, numbers.direction, numbers.choices}[lamp];
                request.wavelengths = &paths[i].wavelengths;
                between.asking[count++] = {i, {static_cast<int>(lamp), 1}};
            });
            auto const requests = std::span(between.requests).first(count);
            scene.lights.light(static_cast<int>(lamp)).answer(requests);
            for (std::size_t k = 0; k < count; ++k) {
                requests[k].normal.setZero();  // for those who ask next, whose densities others know too
                if (!requests[k].sample) continue;
                Walk& walk = walks[between.asking[k].walk];
                CameraPath& path = paths[between.asking[k].walk];
                walk.light = &*requests[k].sample;
                walk.choice = between.asking[k].choice;
                weigh<Rivals::none>(scene, meeting(scene, path, walk), path, walk, between.shadows);
            }
            between.shadows.trace(scene, statistics);
        }
    }

    static Met meeting(Scene const& scene, CameraPath const& path, Walk& walk) {
        Direction const to_viewer = -path.ray.direction;
        describe_meeting(walk.hit.point, to_viewer, walk.numbers.chances.y);
        if constexpr (Lit) {
            std::optional<Surroundings> in;
            if constexpr (Media) in = walk.in;
            return Meeting(scene, walk.hit, to_viewer, path.wavelengths, walk.numbers.chances.y, in);
        } else {
            Surroundings* in = nullptr;
            if constexpr (Media) in = &walk.in;
            return Interaction(scene, walk.hit, to_viewer, path.wavelengths, in);
        }
    }

    // What else may find the light that a light sample brings.
    enum class Rivals { none, scattering };

    // What a light sample brings along the path if nothing stands between.
    template <Rivals rivals = Rivals::scattering>
    void weigh(Scene const& scene, Met const& met, CameraPath& path, Walk const& walk, Shadows& shadows) const {
        LightSample const& light = *walk.light;
        Interaction const& here = seen(met);
        Direction const wi = here.frame.to_local(light.wi);
        BsdfEvaluation const f = here.bsdf.evaluate(here.wo, wi);
        if (is_black(f.value) || !here.is_consistent(light.wi, wi)) return;
        // In units of a steradian: a density for lights of extent, the Dirac's own measure for the others.
        float const cosine = std::abs(wi.z());
        Lanes competitors(walk.choice.probability);
        if (light.density) {
            Lanes found(rivals == Rivals::none ? Lanes(0) : Lanes(f.density.lane));
            if constexpr (Scattering)
                found *= passing_probability(behind(scene, walk.hit, here, wi, walk.in).medium(), light.distance,
                                             path.wavelengths);
            competitors = Lanes(found.lane + walk.choice.probability * light.density->value);
        }
        float divisor = Dispersive ? float(mean(walk.state.reach * competitors)) : competitors[0];
        if constexpr (Lit)
            divisor += light_paths_.instead_of(scene, met, path.wavelengths, light, walk.choice, walk.rivalry);
        Lanes scattered(f.value.lane * (cosine / divisor));
        if constexpr (Media)
            scattered *=
                behind(scene, walk.hit, here, wi, walk.in).medium().transmittance(light.distance, path.wavelengths);
        shadows.add(path, walk.choice.light, walk.state.weight * scattered * light.radiance,
                    spawn_shadow_ray(walk.hit.point, light.wi, light.distance));
    }

    // Make the surface's closure, weigh the lamp's sample by it and choose where the path goes on; false if it ends
    // here.
    [[gnu::flatten]] bool scatter(Scene const& scene, CameraPath& path, Walk& walk, [[maybe_unused]] int bounce,
                                  Shadows& shadows, [[maybe_unused]] RayStatistics& statistics) const {
        if constexpr (Scattering)
            if (walk.is_afloat()) return scatter_afloat(scene, path, walk, bounce, shadows, statistics);
        Met const met = meeting(scene, path, walk);
        Interaction const& here = seen(met);
        if (light_sampling_ && walk.light) weigh(scene, met, path, walk, shadows);
        if constexpr (Scattering)
            if (looks_at_beams(bounce)) light_afloat_.look_at_beam(scene, here, path, walk, shadows, statistics);
        auto const sample = here.bsdf.sample(here.wo, {walk.numbers.choices.y, walk.numbers.direction});
        if (!sample) return false;
        Direction const wi = here.frame.to_world(sample->wi);
        if (!here.is_consistent(wi, sample->wi)) return false;
        if constexpr (Lit) walk.rivalry.scatter(scene, met, path.wavelengths, *sample, wi, walk.state.reach);
        if constexpr (Dispersive) {
            walk.arrival.mean_reach_before = mean(walk.state.reach);
            walk.state.reach *= sample->reach;
        }
        walk.state.weight *= sample->weight;
        walk.arrival.density = sample->density;
        walk.light_is_known = known_.field && sample->density;
        walk.arrival.from = receiver_of(scene, -path.ray.direction, walk);
        if (ray_cones_)
            walk.cone = walk.cone.scattered(walk.hit.distance, sample->density ? &*sample->density : nullptr);
        path.ray = spawn_ray(walk.hit.point, wi);
        if constexpr (Media) walk.in = behind(scene, walk.hit, here, sample->wi, walk.in);
        return true;
    }

    // Whether what a beam lights may be seen from there: one scattering more.
    bool looks_at_beams(int bounce) const { return light_sampling_ && bounce + 1 < max_bounces_; }

    // In a medium: always on, and in all lanes alike.
    bool scatter_afloat(Scene const& scene, CameraPath& path, Walk& walk, int bounce, Shadows& shadows,
                        RayStatistics& statistics) const {
        if (light_sampling_ && walk.light) light_afloat_.weigh(scene, path, walk, shadows);
        if (looks_at_beams(bounce)) light_afloat_.look_at_beam(scene, path, walk, shadows, statistics);
        HenyeyGreenstein const phase(walk.in.medium().asymmetry, path.ray.direction);
        Direction const wi = phase.sample(walk.numbers.direction);
        walk.arrival = {phase.density(wi), {walk.place(), Vector(0, 0, 0)}, mean(walk.state.reach)};
        if (ray_cones_) walk.cone = walk.cone.scattered(walk.floating.at->distance, &*walk.arrival.density);
        path.ray = {walk.place(), wi};
        return true;
    }

    [[no_unique_address]] LightPaths light_paths_;
    KnownIndirect known_;
    std::optional<SplitPilot> pilot_;  // absent: no path is split
    Splits splits_;
    LightSelector selector_;
    [[no_unique_address]] std::conditional_t<Scattering, LightAfloat, NotCarried> light_afloat_;
    int max_bounces_;
    bool light_sampling_, environment_, ray_cones_;
    bool shares_;                            // the paths of a block, what leaves their second vertices
    std::optional<Surroundings> camera_in_;  // absent: to be found for each path
};

// make.operator()<what the plan needs>(): a Path of them.
template <class Make>
std::unique_ptr<Integrator> made_for(RenderPlan const& plan, Make&& make) {
    if (plan.media)
        return plan.dispersion ? make.template operator()<true, true>() : make.template operator()<false, true>();
    return plan.dispersion ? make.template operator()<true, false>() : make.template operator()<false, false>();
}

std::unique_ptr<Integrator> path_of(Scene const& scene, RenderPlan const& plan, KnownIndirect known,
                                    PathHabits const& habits) {
    auto const make = [&]<bool... Needs>() {
        return std::unique_ptr<Integrator>(std::make_unique<Path<Needs...>>(scene, plan, habits, std::move(known)));
    };
    return plan.scattering ? make.template operator()<true, true, true>() : made_for(plan, make);
}

}  // namespace

PathHabits habits_asked_for(IntegratorOptions& options, PathHabits const& usual) {
    int const splits = options.integer("splits", 1, most_splits, usual.splits);
    return {splits, options.boolean("share", usual.share)};
}

std::unique_ptr<Integrator> path_by(PathHabits const& habits, Scene const& scene, RenderPlan const& plan,
                                    IntegratorOptions& options) {
    options.finish();
    return path_of(scene, plan, {}, habits);
}

std::unique_ptr<Integrator> path_until_known(Scene const& scene, RenderPlan const& plan, KnownIndirect known) {
    return path_of(scene, plan, std::move(known), {});
}

std::unique_ptr<Integrator> caustic_path_by(PathHabits const& habits, Scene const& scene, RenderPlan const& plan,
                                            IntegratorOptions& options) {
    AimedLightPaths light_paths = light_paths_asked_for(scene, plan, options, "caustic-path");
    options.finish();
    return made_for(plan, [&]<bool Dispersive, bool Media>() {
        using Lit = Path<Dispersive, Media, false, true>;
        return std::unique_ptr<Integrator>(
            std::make_unique<Lit>(scene, plan, habits, KnownIndirect{}, std::move(light_paths)));
    });
}

}  // namespace iride
