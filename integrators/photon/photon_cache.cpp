// SPDX-License-Identifier: Apache-2.0
#include "integrators/photon/photon_cache.h"

#include "integrators/direct_light.h"

namespace iride {

namespace {

// Of the median distance that holds k photons, how far k are looked for: where light is weak all within count.
constexpr float widest_search = 4;
constexpr std::uint64_t photon_numbers = 0x70686f746f6eull;  // apart from the numbers of camera paths

// Of one lamp, chosen by power; narrow directions are also followed to it.
Radiance direct_light(CachedPoint const& point) {
    LightSet const& lights = point.scene.lights;
    if (!lights.has_power()) return {};
    GatherPoint const& at = point.at;
    auto const choice = lights.choose(point.light.choice);
    auto const light = lights.light(choice.index).sample(at.hit.point.position, point.wavelengths, point.light.place);
    if (!light) return {};
    return from_lamp(
        {point.scene, at.hit, at.here, point.wavelengths, at.state, point.in}, *light, choice.probability,
        [&](LaneDensity const& density, float cosine) { return at.narrow.holds(density, cosine); }, point.statistics);
}

}  // namespace

PhotonCache::PhotonCache(Scene const& scene, RenderPlan const& plan, PhotonSettings const& settings)
    : settings_(settings),
      wavelengths_(make_wavelength_sampler(scene, plan)),
      max_scatterings_(plan.max_bounces.value_or(longest_path)),
      lamps_in_(scene, plan),
      reach_(scene) {}

double PhotonCache::shrinkage(int i, double alpha) {
    return std::exp(std::lgamma(i + alpha) - std::lgamma(1 + alpha) - std::lgamma(i + 1.0));
}

float PhotonCache::widest_radius(PhotonList const& photons, float widest) const {
    if (settings_.radius > 0) return static_cast<float>(settings_.radius);
    float const median = median_distance(photons, static_cast<std::size_t>(settings_.neighbours));
    return median > 0 ? std::min(widest_search * median, widest) : widest;
}

void PhotonCache::prepare(Scene const& scene, SamplePass const& pass, RayStatistics& statistics) {
    int const map = settings_.progressive ? static_cast<int>(pass.first) / settings_.packets : 0;
    if (seed_ == pass.seed && made_ == map) return;
    if (seed_ != pass.seed) {
        seed_ = pass.seed;
        if (map > 0) shoot(scene, pass.seed, 0, statistics);  // for the widest radius
    }
    shoot(scene, pass.seed, map, statistics);
}

void PhotonCache::shoot(Scene const& scene, std::uint64_t seed, int map, RayStatistics& statistics) {
    std::uint64_t const key = hash_words(seed, photon_numbers, map);
    packets_.emplace(wavelengths_, settings_.packets, hash_words(key, 1));
    int const each = (settings_.photons + settings_.packets - 1) / settings_.packets;
    PhotonHarvest harvest =
        shoot_photons(scene, *packets_, {key, each, std::max(0, max_scatterings_ - 1), lamps_in_}, statistics);
    if (map == 0) {
        float const widest = scene.radius() / 10;
        caustic_widest_ = widest_radius(harvest.caustic, widest);
        indirect_widest_ = widest_radius(harvest.indirect, widest);
    }
    auto const share = static_cast<float>(settings_.progressive ? std::sqrt(shrinkage(map + 1, settings_.alpha)) : 1);
    auto const make = [&](PhotonList& photons, float widest) {
        return PhotonMap(std::move(photons), reach_, {widest, settings_.neighbours, share}, widest / widest_search);
    };
    caustic_ = make(harvest.caustic, caustic_widest_);
    indirect_ = make(harvest.indirect, indirect_widest_);
    made_ = map;
}

Radiance PhotonCache::direct_and_caustic(CachedPoint const& point) const {
    if (point.at.scatterings >= max_scatterings_) return {};
    return direct_light(point) + caustic_.brought(point.at);
}

Radiance PhotonCache::all(CachedPoint const& point) const {
    return direct_and_caustic(point) + indirect_.brought(point.at);
}

}  // namespace iride
