// SPDX-License-Identifier: Apache-2.0
#include "integrators/photon/photon_integrators.h"

#include <utility>

#include "integrators/arrival.h"
#include "integrators/media.h"
#include "integrators/photon/photon_cache.h"
#include "integrators/photon/radiosity_cache.h"

namespace iride {

namespace {

constexpr int roulette_from = 3;  // scatterings before a camera path may end by chance

class PhotonIntegrator final : public Integrator {
  public:
    PhotonIntegrator(Scene const& scene, RenderPlan const& plan, PhotonSettings const& settings, bool gathers,
                     bool over_radiosity)
        : photons_(scene, plan, settings),
          narrow_{static_cast<float>(settings.narrow)},
          together_(settings.progressive ? settings.packets : std::numeric_limits<int>::max()),
          gathers_(gathers),
          max_bounces_(plan.max_bounces.value_or(longest_path)),
          camera_in_(plan.media ? plan.camera_in : Surroundings()) {
        if (over_radiosity) radiosity_.emplace(scene, plan, photons_);
    }

    void prepare(Scene const& scene, SamplePass const& pass, RayStatistics& statistics) override {
        photons_.prepare(scene, pass, statistics);
    }
    int samples_alike(std::uint32_t first) const override {
        return together_ - static_cast<int>(first % static_cast<std::uint32_t>(together_));
    }
    bool shares_light_paths() const override { return true; }

    void follow(Scene const& scene, std::span<CameraPath> paths, RayStatistics& statistics) const override {
        for (CameraPath& path : paths) follow_one(scene, path, statistics);
    }

  private:
    RadianceCache const& cache() const {
        return radiosity_ ? static_cast<RadianceCache const&>(*radiosity_) : photons_;
    }

    void follow_one(Scene const& scene, CameraPath& path, RayStatistics& statistics) const {
        Sampler& sampler = path.sampler;
        int const packet = photons_.packets().choose(sampler.next());
        Wavelengths const& wavelengths = path.wavelengths = photons_.packets().packet(packet);
        Ray ray = path.ray;
        Surroundings in = camera_in_ ? *camera_in_ : surroundings_at(scene, ray.origin);
        PathState state;
        Arrival arrival;
        bool gathering = gathers_, lamps_are_seen = true;  // false: the last vertex has gathered them
        for (int bounce = 0;; ++bounce) {
            auto const meet = [&](Hit const* met) {
                if (lamps_are_seen)
                    path.radiance += lamps_met(scene, ray, met, wavelengths, state, arrival,
                                               [&](int light) { return scene.lights.probability(light); });
            };
            std::optional<Hit> hit;
            if (!reach_surface(scene, wavelengths, ray, in, state.weight, hit, statistics, [&](Hit const& passed) {
                    meet(&passed);
                    arrival.density.reset();  // no light sample gets further
                }))
                return void(path.complete = false);
            meet(hit ? &*hit : nullptr);
            if (!hit) return;
            if (bounce >= max_bounces_) return void(path.complete = max_bounces_ < longest_path);

            sampler.begin_vertex(static_cast<std::uint32_t>(bounce));
            Sample2 const choices = sampler.next2(), light = sampler.next2(), direction = sampler.next2(),
                          chances = sampler.next2();
            describe_meeting(hit->point, -ray.direction, chances.y);
            Interaction const here(scene, *hit, -ray.direction, wavelengths, &in);
            if (here.bsdf.has_density()) {
                Direction const& g = here.geometric_normal;
                Direction const side = ray.direction.dot(g) > 0 ? Direction(-g) : g;
                bool const both_sides = !scene.material(hit->shape->material).traits.two_sided;
                CachedPoint const point{
                    scene,       {*hit, here, state, side, both_sides, packet, bounce, max_bounces_, narrow_},
                    ray,         in,
                    wavelengths, {choices.x, light},
                    statistics};
                path.radiance += gathering ? cache().direct_and_caustic(point) : cache().all(point);
            }
            auto const sample = here.bsdf.sample(here.wo, {choices.y, direction});
            if (!sample) return;
            Direction const wi = here.frame.to_world(sample->wi);
            if (!here.is_consistent(wi, sample->wi)) return;
            if (!goes_on(*sample, state, hit->point.position, gathering, lamps_are_seen, arrival)) return;
            state.weight *= sample->weight;
            state.reach *= sample->reach;
            in = behind(scene, *hit, here, sample->wi, in);
            ray = spawn_ray(hit->point, wi);
            if (bounce >= roulette_from && !survives<true>(state, chances.x)) return;
        }
    }

    // False where what comes from that direction has been gathered.
    bool goes_on(BsdfSample const& sample, PathState const& state, Vector const& from, bool& gathering,
                 bool& lamps_are_seen, Arrival& arrival) const {
        arrival.density.reset();
        if (!sample.density) return true;
        if (narrow_.holds(sample.density->value * mean(sample.reach), std::abs(sample.wi.z()))) {
            arrival = {sample.density, {from}, mean(state.reach)};
            lamps_are_seen = true;
            return gathering || !cache().has_narrow();
        }
        lamps_are_seen = false;
        return std::exchange(gathering, false);
    }

    PhotonCache photons_;
    Narrowness narrow_;
    std::optional<RadiosityCache> radiosity_;
    int together_;
    bool gathers_;
    int max_bounces_;
    std::optional<Surroundings> camera_in_;  // absent: to be found for each path
};

// What photons need of a scene.
void check_scene(Scene const& scene, RenderPlan const& plan, std::string const& name) {
    if (!scene.lights.has_power())
        throw InputError({}, "integrator",
                         name +
                             ": no lamp of the scene has any power, so no photon can be emitted; allowed: a scene "
                             "with an emission, a light or an environment");
    if (!plan.light_sampling)
        throw InputError({}, "integrator",
                         name +
                             ": every surface is a mirror, glass or black, so no photon can be kept; allowed: a scene "
                             "with a diffuse or rough surface, or the integrator path");
}

std::unique_ptr<Integrator> make(Scene const& scene, RenderPlan const& plan, IntegratorOptions& options,
                                 std::string const& name, PhotonSettings s, bool gathers) {
    constexpr int most_photons = 1 << 28;
    s.photons = options.integer("photons", 1, most_photons, s.photons);
    s.radius = options.number("radius", at_least(0), s.radius);
    s.packets = options.integer("packets", 1, 1024, s.packets);
    if (s.progressive) s.alpha = options.number("alpha", {.least = 0, .most = 1, .least_excluded = true}, s.alpha);
    s.neighbours = options.integer("neighbours", 2, 1 << 20, s.neighbours);
    s.narrow = options.number("narrow", at_least(1), s.narrow);
    bool over_radiosity = false;
    static constexpr std::pair<char const*, bool> sources[]{{"photons", false}, {"radiosity", true}};
    if (gathers) over_radiosity = options.one_of("source", sources, false);
    options.finish();
    check_scene(scene, plan, name);
    return std::make_unique<PhotonIntegrator>(scene, plan, s, gathers, over_radiosity);
}

}  // namespace

std::unique_ptr<Integrator> make_photon_map(Scene const& scene, RenderPlan const& plan, IntegratorOptions& options) {
    return make(scene, plan, options, "photon-map", {}, false);
}
std::unique_ptr<Integrator> make_progressive_photon(Scene const& scene, RenderPlan const& plan,
                                                    IntegratorOptions& options) {
    return make(scene, plan, options, "progressive-photon",
                {.photons = 100000, .neighbours = 40, .packets = 4, .progressive = true}, false);
}
std::unique_ptr<Integrator> make_final_gather(Scene const& scene, RenderPlan const& plan, IntegratorOptions& options) {
    return make(scene, plan, options, "final-gather", {}, true);
}

}  // namespace iride
