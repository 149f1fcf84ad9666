// SPDX-License-Identifier: Apache-2.0
// What a path of a batch carries from stage to stage, by what its scene needs.
#pragma once

#include "integrators/aimed_light_paths.h"
#include "integrators/arrival.h"
#include "integrators/flight.h"
#include "integrators/path_batch.h"

namespace iride {

struct NotCarried {
    NotCarried() = default;
    template <class... What>
    explicit NotCarried(What const&...) {}
};

// What light paths might have found in a path's stead.
struct Rivalry : OtherSide<BesideLightPaths> {
    float passed = 0;  // metres through surfaces that are none

    void pass(float distance) {
        passed += distance;
        near = Lanes();
    }
    void scatter(Scene const& scene, Meeting const& at, Wavelengths const& wavelengths, BsdfSample const& sample,
                 Direction const& on, Lanes const& reach) {
        passed = 0;
        if (sample.density) {
            go_on(at.cosine(on), sample, reach, [&] { return at.density_back(scene, wavelengths, on); });
        } else {
            go_on_through_dirac(at.cosine(at.back()), sample, at.squared_index_ratio(scene, wavelengths, on));
            if (!at.is_framed_alike(scene, wavelengths, on)) far = Lanes();  // no light path comes this way
        }
    }
};

// The decisions of a path in media that scatter, beside those at its vertex.
struct FlightNumbers {
    float depth, lamp;
    Sample2 places;     // x: on the path's ray, y: on a beam
    Sample2 direction;  // of the beam

    void draw(Sampler& sampler) {
        Sample2 const first = sampler.next2();
        depth = first.x;
        lamp = first.y;
        places = sampler.next2();
        direction = sampler.next2();
    }
};

// What a path carries through media that scatter.
struct Floating {
    FlightNumbers numbers;
    std::optional<Afloat> at;  // present: the path is afloat
    float reach_before = 1;    // mean reach where the latest flight began, or its part behind a surface that is none
    float farthest = 1;        // greatest distance so far from the middle of all there is, in its radii, at least 1
};

// A path under way, at its latest vertex: on a surface, or afloat in a medium that scatters.
template <bool Media, bool Scattering, bool Lit>
struct Walk {
    PathState state;
    Arrival arrival;
    RayCone cone;  // 0 wide unless the plan carries it
    VertexNumbers numbers;
    bool has_hit;
    bool light_is_known = false;  // of the next surface, but for what it emits
    Hit hit;
    LightSample const* light;      // that of the lamp asked; null: none
    LightSelector::Choice choice;  // of that lamp
    [[no_unique_address]] std::conditional_t<Media, Surroundings, NotCarried> in;
    [[no_unique_address]] std::conditional_t<Scattering, Floating, NotCarried> floating;
    [[no_unique_address]] std::conditional_t<Lit, Rivalry, NotCarried> rivalry;

    void begin_vertex(Sampler& sampler, std::uint32_t vertex) {
        sampler.begin_vertex(vertex, numbers);
        if constexpr (Scattering) floating.numbers.draw(sampler);
    }
    // What decides how far it flies.
    float flight_depth() const {
        if constexpr (Scattering) return floating.numbers.depth;
        return 0;
    }
    // The normal on the side that the path comes from.
    Direction side_of(Direction const& to_viewer) const {
        Direction const& n = hit.point.geometric_normal;
        return to_viewer.dot(n) < 0 ? Direction(-n) : n;
    }
    bool is_afloat() const {
        if constexpr (Scattering) return floating.at.has_value();
        return false;
    }
    Vector place() const {
        if constexpr (Scattering)
            if (floating.at) return floating.at->position;
        return hit.point.position;
    }
};

// Whether the surface there scatters other than by Dirac lobes.
template <class Walk>
bool is_dense(Scene const& scene, Walk const& walk) {
    return scene.material(walk.hit.shape->material).traits.has_density;
}
// Whether what leaves it is the same in all directions.
template <class Walk>
bool is_lambertian(Scene const& scene, Walk const& walk) {
    return !walk.is_afloat() && scene.material(walk.hit.shape->material).traits.lambertian;
}
// Whether it scatters so evenly that light samples alone find its light.
template <class Walk>
bool is_diffuse(Scene const& scene, Walk const& walk) {
    return !walk.is_afloat() && scene.material(walk.hit.shape->material).traits.diffuse;
}

// The ends of the rays of those alive.
template <class Walk>
void find_hits(Scene const& scene, std::span<CameraPath const> paths, std::array<Walk, batch_size>& walks,
               Alive const& alive, Accelerator::Coherence coherence, std::array<ClosestQuery, batch_size>& queries,
               RayStatistics& statistics) {
    std::size_t count = 0;
    alive.for_each([&](std::size_t i) {
        ClosestQuery& query = queries[count++];
        query.ray = &paths[i].ray;
        query.hit = &walks[i].hit;
        query.cone = walks[i].cone;
    });
    scene.accelerator->closest(std::span(queries).first(count), coherence, statistics);
    count = 0;
    alive.for_each([&](std::size_t i) { walks[i].has_hit = queries[count++].found; });
}

// Take the path along its ray; true if the surface there is none.
template <bool Media, bool Scattering, bool Lit>
bool travel_once(Scene const& scene, CameraPath& path, Walk<Media, Scattering, Lit>& walk,
                 [[maybe_unused]] Flight& flight) {
    Hit const* const hit = walk.has_hit ? &walk.hit : nullptr;
    if constexpr (!Scattering) {
        return travel(scene, hit, path.wavelengths, path.ray, walk.in, walk.state.weight);
    } else {
        float passing = 1;
        bool const through =
            fly(scene, hit, path.wavelengths, flight, path.ray, walk.in, walk.state, passing, walk.floating.at);
        if (walk.arrival.density) walk.arrival.density->value *= passing;
        return through;
    }
}

// mean(next.reach) + mean(state.reach) p_light / p_hero.
template <bool Dispersive, class Walk>
float mixture(Walk const& walk, float light_density) {
    float const reach = Dispersive ? float(mean(walk.state.reach)) : 1.0f;
    Arrival const& arrival = walk.arrival;
    if (!arrival.density) return reach;
    return reach + arrival.mean_reach_before * light_density / arrival.density->value;
}

inline Interaction const& seen(Interaction const& here) { return here; }
inline Interaction const& seen(Meeting const& here) { return here.seen(); }

// Parts of a batch's paths, that are followed together.
template <class Walk>
class Parts {
  public:
    explicit Parts(std::span<CameraPath> whole) : all_(whole) {}

    std::size_t size() const { return count_; }
    std::span<CameraPath> paths() { return std::span(paths_).first(count_); }
    std::array<Walk, batch_size>& walks() { return walks_; }
    // The number of the path that it is a part of.
    std::size_t whole(std::size_t part) const { return whole_[part]; }

    // Part k of `parts` of path `whole` at its first vertex.
    void add(std::size_t whole, Walk const& walk, std::uint32_t k, std::uint32_t parts) {
        CameraPath& part = paths_[count_];
        part = all_[whole];
        part.radiance = Radiance();
        part.part = 1 / static_cast<float>(parts);
        part.sampler.split(k, parts);
        walks_[count_] = walk;
        walks_[count_].begin_vertex(part.sampler, 0);
        whole_[count_++] = whole;
    }
    // To the paths they are of what they have brought.
    void gather() {
        for (std::size_t k = 0; k < count_; ++k) {
            all_[whole_[k]].radiance += paths_[k].radiance;
            all_[whole_[k]].complete &= paths_[k].complete;
        }
        count_ = 0;
    }

  private:
    std::span<CameraPath> all_;
    std::array<CameraPath, batch_size> paths_;
    std::array<std::size_t, batch_size> whole_;
    std::array<Walk, batch_size> walks_;
    std::size_t count_ = 0;
};

}  // namespace iride
