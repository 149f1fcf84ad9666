// SPDX-License-Identifier: Apache-2.0
// Paths that start at a light, as `light-tracing` and `bidirectional` follow them, and what one of their vertices shows
// to the camera. Light vertex 0 lies on the light; its weights know that a vertex lit directly may have drawn it from
// there (scene/light.h) or have met it by scattering.
#pragma once

#include "integrators/light_emission_choice.h"
#include "integrators/light_surroundings.h"
#include "integrators/media.h"
#include "integrators/path_batch.h"
#include "integrators/sightings.h"
#include "integrators/splits.h"
#include "integrators/subpath.h"
#include "scene/camera_importance.h"

namespace iride {

// What is the same for all paths of a picture.
struct TwoWayContext {
    CameraImportance camera;
    Ball ball;
    LightSurroundings lamps_in;
    LightSelector selector;  // of the camera paths
    float share;             // of the camera paths that a light path goes with
    float pixels;
    int max_bounces;

    TwoWayContext(Scene const& scene, RenderPlan const& plan, LightSelection selection = LightSelection::power,
                  float share_of_paths = 1)
        : camera(scene.camera, scene.film.width, scene.film.height),
          ball{scene.centre(), scene.radius()},
          lamps_in(scene, plan),
          selector(scene.lights, selection, plan.uniform_light),
          share(share_of_paths),
          pixels(static_cast<float>(scene.film.width) * static_cast<float>(scene.film.height)),
          max_bounces(plan.max_bounces.value_or(longest_path)) {}

    // For each camera path of a pixel.
    float light_paths() const { return share * pixels; }

    // With which a camera path that meets `hit` from the side of `wi` asks a light.
    float chosen(Scene const& scene, Hit const& hit, Direction const& wi, int light) const {
        Direction const& n = hit.point.geometric_normal;
        return selector.probability(receiver(scene, hit, wi.dot(n) < 0 ? Direction(-n) : n), light);
    }
};

template <class Heuristic>
struct LightVertex {
    Meeting meeting;
    Subpath<Heuristic> path;
    int number;  // scatterings with the one here
};

// Blocks of random numbers of light vertices lie beyond those of camera paths.
inline constexpr std::uint32_t light_block = 1u << 20;
static_assert(light_block > longest_path);

// The way to the next surface that is one, through those that are none: passed(hit) is called for each of them. No
// vertex is joined with another through them, so `near` ends there.
struct Way {
    std::optional<Hit> hit;
    float length = 0;  // to the hit
    bool complete = true;
};
template <class Heuristic, class Passed>
Way follow_to_surface(Scene const& scene, Wavelengths const& wavelengths, Ray& ray, std::optional<Surroundings>& in,
                      Subpath<Heuristic>& walk, RayStatistics& statistics, Passed&& passed) {
    Way way;
    if (in)
        way.complete =
            reach_surface(scene, wavelengths, ray, *in, walk.state.weight, way.hit, statistics, [&](Hit const& hit) {
                passed(hit);
                way.length += hit.distance;
                walk.near = Lanes();
            });
    else
        way.hit = scene.accelerator->closest(ray, statistics);
    if (way.hit) way.length += way.hit->distance;
    return way;
}

// A light path under way: what it has gathered before the ray at hand, and the hit where that ends.
template <class Heuristic>
struct LightWalk {
    LightStart start;
    Flux flux;  // there
    Subpath<Heuristic> path;
    Ray ray;
    std::optional<Surroundings> in;
    Hit hit;
    float length;  // of the way to the hit
    bool joined;   // false: it leads through surfaces that are none
};

// The numbers of a start and of a vertex: a block of the sampler each.
struct LightStartNumbers {
    Sample2 choice, place, direction, lens;  // choice: x
};
struct LightVertexNumbers {
    Sample2 choices, lens, direction, chances;  // choices: y: which lobe; chances: x: roulette, y: part of a mixture
};

// Walk from the lights with some camera paths, at most batch_size, each on a walk of its own, vertex by vertex: within
// a stage they are independent of one another, as in integrators/path.cpp. on_start(path, LightStart, Sample2) is
// called once with numbers for the lens, on_vertex(path, LightVertex, flux, Sample2) at each vertex that has a density.
// Sets path.complete to false where it gives up.
template <class Heuristic, class Emission, class Start, class Visit>
void walk_from_lights(Scene const& scene, TwoWayContext const& context, Emission const& emission,
                      std::span<CameraPath> paths, std::span<LightWalk<Heuristic>> walks, RayStatistics& statistics,
                      Start&& on_start, Visit&& on_vertex) {
    Alive alive(paths.size());
    alive.keep_if([&](std::size_t i) { return start_walk(scene, context, emission, paths[i], walks[i], on_start); });
    for (int number = 1; number <= context.max_bounces && !alive.none(); ++number) {
        find_surfaces(scene, paths, walks, alive, statistics);
        alive.keep_if(
            [&](std::size_t i) { return visit_vertex(scene, context, number, paths[i], walks[i], on_vertex); });
    }
}

// False if no light path goes with this camera path.
template <class Heuristic, class Emission, class Start>
[[gnu::flatten]] bool start_walk(Scene const& scene, TwoWayContext const& context, Emission const& emission,
                                 CameraPath& path, LightWalk<Heuristic>& walk, Start& on_start) {
    LightStartNumbers u;
    path.sampler.begin_vertex(light_block, u);
    if (u.choice.x >= context.share) return false;
    auto const start =
        emission.start(scene, context.ball, path.wavelengths, u.choice.x / context.share, u.place, u.direction);
    if (!start) return false;
    on_start(path, *start, u.lens);
    walk.start = *start;
    walk.flux = start->sample.flux() * (1 / (start->probability * context.share));
    Light const& light = scene.lights.light(start->light);
    walk.path = {};
    walk.ray = leaving_ray(light, start->sample);
    walk.in = context.lamps_in.at(scene, start->light, walk.ray.origin);
    if (walk.in) walk.path.state.weight *= LightSurroundings::left(light, *walk.in, path.wavelengths);
    return true;
}

// To the ends of the rays; walks that find none have ended.
template <class Heuristic>
void find_surfaces(Scene const& scene, std::span<CameraPath> paths, std::span<LightWalk<Heuristic>> walks, Alive& alive,
                   RayStatistics& statistics) {
    std::array<ClosestQuery, batch_size> queries;
    std::size_t count = 0;
    alive.for_each([&](std::size_t i) {
        if (!walks[i].in) queries[count++] = {&walks[i].ray, &walks[i].hit};
    });
    scene.accelerator->closest(std::span(queries).first(count), Accelerator::Coherence::none, statistics);
    count = 0;
    alive.keep_if([&](std::size_t i) {
        LightWalk<Heuristic>& walk = walks[i];
        walk.joined = true;
        if (!walk.in) {
            walk.length = walk.hit.distance;
            return queries[count++].found;
        }
        Way const way = follow_to_surface(scene, paths[i].wavelengths, walk.ray, walk.in, walk.path, statistics,
                                          [&](Hit const&) { walk.joined = false; });
        paths[i].complete &= way.complete;
        if (!way.hit || !way.complete) return false;
        walk.hit = *way.hit;
        walk.length = way.length;
        return true;
    });
}

// Its vertex `number`, and where it goes on from there; false if it ends.
template <class Heuristic, class Visit>
[[gnu::flatten]] bool visit_vertex(Scene const& scene, TwoWayContext const& context, int number, CameraPath& path,
                                   LightWalk<Heuristic>& walk, Visit& on_vertex) {
    Hit const& hit = walk.hit;
    Direction const back = -walk.ray.direction;
    float const arriving = std::abs(back.dot(hit.point.geometric_normal));
    if (!(arriving > 0)) return false;
    LightStart const& start = walk.start;
    if (number == 1)
        begin(scene.lights.light(start.light), start, hit, arriving,
              walk.joined ? context.chosen(scene, hit, back, start.light) : 0, walk.path);
    else
        walk.path.arrive(walk.length, arriving);
    LightVertexNumbers u;
    path.sampler.begin_vertex(light_block + static_cast<std::uint32_t>(number), u);
    LightVertex<Heuristic> const here{Meeting(scene, hit, back, path.wavelengths, u.chances.y, walk.in), walk.path,
                                      number};
    if (here.meeting.seen().bsdf.has_density()) on_vertex(path, here, walk.flux, u.lens);
    if (number == longest_path) path.complete = false;
    if (number == context.max_bounces ||
        !scatter_light(scene, path.wavelengths, here.meeting, {u.choices.y, u.direction}, walk.path, walk.ray))
        return false;
    walk.in = here.meeting.beside(scene, walk.ray.direction);
    constexpr int roulette_from = 2;
    return number <= roulette_from || survives<true>(walk.path.state, u.chances.x);
}

// near and far at the first vertex: the light drawn from there, with that probability of being chosen, and met from
// there by scattering.
template <class Heuristic>
void begin(Light const& light, LightStart const& start, Hit const& hit, float arriving, float chosen_from_there,
           Subpath<Heuristic>& walk) {
    EmissionSample const& e = start.sample;
    float const found = start.probability * e.density.product();
    float far = 0, near = 0;
    switch (light.extent()) {
        case LightExtent::area:
            far = e.cosine / (found * arriving);
            near = far * chosen_from_there * light.density(hit.point.position, e.from, e.primitive).value;
            break;
        case LightExtent::environment:
            far = 1 / (found * arriving);
            near = far * chosen_from_there * light.arriving_density(-e.travel).value;
            break;
        case LightExtent::point:
            near = chosen_from_there * square(hit.distance) / (found * arriving);
            break;
        case LightExtent::distant:
            near = chosen_from_there / (found * arriving);
            break;
    }
    walk.far = Lanes(Heuristic::of(far));
    walk.near = Lanes(Heuristic::of(near));
}

// Choose where light goes on, as power; false if it ends here.
template <class Heuristic>
bool scatter_light(Scene const& scene, Wavelengths const& wavelengths, Meeting const& here, Sample3 u,
                   Subpath<Heuristic>& walk, Ray& ray) {
    Interaction const& seen = here.seen();
    auto const sample = seen.bsdf.sample(seen.wo, u);
    if (!sample) return false;
    Direction const on = seen.frame.to_world(sample->wi);
    if (!(here.cosine(on) > 0)) return false;
    if (sample->density) {
        Scattering const s = here.scattering(scene, wavelengths, on, here.back());
        float const scale = here.adjoint_cosine(s.cosine, here.back(), on) / sample->density->value;
        walk.state.weight *= Throughput(s.value.lane * scale);
        walk.go_on(here, *sample, on, [&] { return Lanes(s.density.lane); });
    } else {
        if (!seen.is_consistent(on, sample->wi) || !here.is_framed_alike(scene, wavelengths, on)) return false;
        Lanes const ratio = here.squared_index_ratio(scene, wavelengths, on);
        walk.state.weight *= sample->weight * ratio * here.adjoint_of_dirac(on);
        walk.go_on_through_dirac(here, *sample, ratio);
    }
    if (is_black(walk.state.weight)) return false;
    ray = spawn_ray(here.point(), on);
    return true;
}

// What light vertex `here` adds to the picture. `weighed`: against the camera paths that make the same.
template <class Heuristic>
std::optional<SentToCamera> send_to_camera(Scene const& scene, TwoWayContext const& context,
                                           Wavelengths const& wavelengths, LightVertex<Heuristic> const& here,
                                           Flux const& flux, Sample2 lens, bool weighed, Splits const& splits = {}) {
    Meeting const& at = here.meeting;
    auto const sight = context.camera.sight_of(at.point().position, lens);
    if (!sight) return std::nullopt;
    Direction const& viewer = sight->towards;
    Scattering const s = at.scattering(scene, wavelengths, viewer, at.back());
    if (is_black(s.value)) return std::nullopt;
    float const density = sight->density * static_cast<float>(splits.at(sight->x, sight->y)) / context.light_paths();
    Lanes techniques = Heuristic::of(here.path.state.reach);
    if (weighed)
        techniques += here.path.others(Lanes(1 / Heuristic::shown(1 / (density * at.cosine(viewer)))),
                                       [&] { return Lanes(s.density.lane); });
    float const scale = at.adjoint_cosine(s.cosine, at.back(), viewer) * sight->density / float(mean(techniques));
    Throughput const arriving = here.path.state.weight * at.let_through(scene, wavelengths, viewer, sight->distance);
    return send(at.point(), *sight, Radiance(flux.lane * arriving.lane * s.value.lane * scale));
}

}  // namespace iride
