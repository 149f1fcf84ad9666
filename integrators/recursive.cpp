// SPDX-License-Identifier: Apache-2.0
#include "integrators/recursive.h"

#include <algorithm>
#include <array>

#include "integrators/direct_light.h"

namespace iride {

namespace {

struct Generations {
    int most = 1;    // scatterings on the way from a lamp to the camera
    int splits = 1;  // rays that go on from a meeting
};
// Beyond this many meetings a chain is no longer parted: the number of rays would double each time.
constexpr int last_split = 4;
constexpr int most_splits = 16;

class Recursive final : public Integrator {
  public:
    Recursive(Scene const& scene, RenderPlan const& plan, DirectLightSettings const& settings,
              Generations const& generations)
        : direct_(scene, settings),
          generations_(generations),
          lamps_(scene.lights.has_power()),
          camera_in_(plan.media ? plan.camera_in : Surroundings()) {}

    void follow(Scene const& scene, std::span<CameraPath> paths, RayStatistics& statistics) const override {
        for (CameraPath& path : paths) {
            Tree tree{scene, path, statistics};
            grow(tree, path.ray, {}, camera_in_ ? *camera_in_ : surroundings_at(scene, path.ray.origin), 0);
        }
    }

  private:
    // All rays of one camera path.
    struct Tree {
        Scene const& scene;
        CameraPath& path;
        RayStatistics& statistics;
        std::uint32_t vertices = 0;
    };

    // A ray of the given generation and all that come of it.
    void grow(Tree& tree, Ray ray, PathState state, Surroundings in, int generation) const {
        auto const& [scene, path, statistics, _] = tree;
        float const per_reach = 1 / mean(state.reach);
        std::optional<Hit> hit;
        if (!reach_surface(scene, path.wavelengths, ray, in, state.weight, hit, statistics, [&](Hit const& passed) {
                path.radiance += state.weight * emitted_at(scene, passed, ray, path.wavelengths) * per_reach;
            }))
            return void(path.complete = false);
        path.radiance += state.weight * seen_along(scene, ray, hit, path.wavelengths) * per_reach;
        if (hit && generation < generations_.most) scatter(tree, *hit, ray, state, in, generation);
    }

    void scatter(Tree& tree, Hit& hit, Ray const& ray, PathState const& state, Surroundings const& in,
                 int generation) const {
        auto const& [scene, path, statistics, _] = tree;
        path.sampler.begin_vertex(tree.vertices++);
        describe_meeting(hit.point, -ray.direction, path.sampler.next());
        Interaction const here(scene, hit, -ray.direction, path.wavelengths, &in);
        int const splits = generation < last_split ? generations_.splits : 1;
        float const first = path.sampler.next();
        std::array<Sample2, most_splits> directions;
        for (int i = 0; i < splits; ++i) directions[static_cast<std::size_t>(i)] = path.sampler.next2();
        if (lamps_)
            path.radiance += direct_.at({scene, hit, here, path.wavelengths, state, in}, path.sampler, statistics);
        for (int i = 0; i < splits; ++i) {
            constexpr float below_one = 0x1.fffffep-1f;  // the sum may round up
            float const lobe = std::min((static_cast<float>(i) + first) / static_cast<float>(splits), below_one);
            auto const sample = here.bsdf.sample(here.wo, {lobe, directions[static_cast<std::size_t>(i)]});
            if (!sample || sample->density) continue;
            Direction const wi = here.frame.to_world(sample->wi);
            if (!here.is_consistent(wi, sample->wi)) continue;
            PathState next = state;
            next.weight *= sample->weight;
            next.weight /= static_cast<float>(splits);
            next.reach *= sample->reach;
            grow(tree, spawn_ray(hit.point, wi), next, behind(scene, hit, here, sample->wi, in), generation + 1);
        }
    }

    DirectLight direct_;
    Generations generations_;
    bool lamps_;
    std::optional<Surroundings> camera_in_;  // absent: to be found for each path
};

constexpr std::pair<char const*, std::optional<LightSelection>> selections[]{{"uniform", LightSelection::uniform},
                                                                             {"power", LightSelection::power},
                                                                             {"tree", LightSelection::tree},
                                                                             {"all", std::nullopt}};

// Lights that no direction meets: neither shapes nor environments.
bool has_lights_without_extent(Scene const& scene) {
    std::vector<bool> met(scene.lights.size());
    for (Shape const& s : scene.shapes)
        if (s.light >= 0) met[static_cast<std::size_t>(s.light)] = true;
    for (int e : scene.lights.environments()) met[static_cast<std::size_t>(e)] = true;
    return std::ranges::find(met, false) != met.end();
}

}  // namespace

std::unique_ptr<Integrator> make_direct(Scene const& scene, RenderPlan const& plan, IntegratorOptions& options) {
    using enum DirectStrategy;
    constexpr std::pair<char const*, DirectStrategy> strategies[]{
        {"hemisphere", hemisphere},   {"cosine", cosine}, {"bsdf", bsdf}, {"area", area},
        {"solid-angle", solid_angle}, {"mis", mis}};
    DirectLightSettings settings;
    settings.strategy = options.one_of("strategy", strategies, mis);
    settings.selection = options.one_of("lights", selections, std::optional(plan.light_selection));
    settings.samples = options.integer("samples", 1, 1 << 16, 1);
    bool const by_direction =
        settings.strategy == hemisphere || settings.strategy == cosine || settings.strategy == bsdf;
    if (by_direction && has_lights_without_extent(scene))
        options.error_at("strategy",
                         "the scene has point, spot or distant lights, which no direction meets; allowed: "
                         "area, solid-angle, mis");
    options.finish();
    return std::make_unique<Recursive>(scene, plan, settings,
                                       Generations{.most = std::min(1, plan.max_bounces.value_or(1))});
}

std::unique_ptr<Integrator> make_recursive(Scene const& scene, RenderPlan const& plan, IntegratorOptions& options) {
    DirectLightSettings settings;
    settings.selection = options.one_of("lights", selections, std::optional(plan.light_selection));
    Generations generations;
    generations.most = options.integer("generations", 0, 1000, plan.max_bounces.value_or(8));
    generations.splits = options.integer("splits", 1, most_splits, 2);
    options.finish();
    return std::make_unique<Recursive>(scene, plan, settings, generations);
}

}  // namespace iride
