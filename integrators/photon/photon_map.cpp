// SPDX-License-Identifier: Apache-2.0
#include "integrators/photon/photon_map.h"

namespace iride {

namespace {

// A photon lies on the plane through p if its height is below this share of its distance: surfaces curve, layers do not
// touch.
constexpr float flatness = 0.3f;
constexpr float alike = 0.8f;  // cosine between normals of one smooth surface, over the width of a neighbourhood

bool lies_beside(Photon const& photon, GatherPoint const& at) {
    constexpr float rounding = 1e-5f;  // m: two places on a plane, as floats
    Vector const d = photon.position - at.hit.point.position;
    float const turned = photon.normal.dot(at.side);
    return (at.both_sides ? std::abs(turned) : turned) > alike &&
           std::abs(d.dot(at.side)) <= flatness * d.norm() + rounding;
}

std::vector<PhotonGrid::Entry> entries_of(PhotonList const& list) {
    std::vector<PhotonGrid::Entry> entries;
    entries.reserve(list.size());
    for (std::size_t i = 0; i < list.size(); ++i)
        entries.push_back({list.photon[i].position, list.photon[i].packet, static_cast<std::uint32_t>(i)});
    return entries;
}

}  // namespace

PhotonMap::PhotonMap(PhotonList photons, float cell)
    : photons_(std::move(photons)), grid_(entries_of(photons_), cell) {}

Flux PhotonMap::scattered(GatherPoint const& at, std::uint32_t index) const {
    Photon const& photon = photons_.photon[index];
    PhotonPower const& power = photons_.power[index];
    Interaction const& here = at.here;
    if (at.scatterings + 1 + photon.scatterings > at.max_scatterings) return {};
    Direction const wi = here.frame.to_local(photon.wi);
    if (!here.is_consistent(photon.wi, wi)) return {};
    float const cosine = std::abs(photon.wi.dot(here.geometric_normal));
    if (!(cosine > 0)) return {};
    BsdfEvaluation const f = here.bsdf.evaluate(here.wo, wi);
    if (photon.can_be_followed && at.narrow.holds(f.density, std::abs(wi.z()))) return {};
    float const scale = std::abs(wi.z()) / (cosine * mean(at.state.reach * power.reach));
    return Flux(f.value.lane * power.flux.lane * at.state.weight.lane * scale);
}

Radiance PhotonMap::brought(GatherPoint const& at, Neighbourhood const& around) const {
    if (grid_.size() == 0) return {};
    thread_local std::vector<PhotonGrid::Neighbour> found;
    auto const packet = static_cast<std::uint32_t>(at.packet);
    auto const wanted = [&](PhotonGrid::Entry const& e, float) { return lies_beside(photons_.photon[e.index], at); };
    float const radius2 =
        square(around.share) *
        grid_.nearest(at.hit.point.position, around.radius, static_cast<std::size_t>(around.neighbours), wanted, found);
    Flux sum;
    for (PhotonGrid::Neighbour const& f : found)
        if (f.entry->group == packet && f.distance2 < radius2) sum += scattered(at, f.entry->index);
    return Radiance(sum.lane / (pi * radius2));
}

float median_distance(PhotonList const& photons, std::size_t count) {
    constexpr std::size_t asked = 31;
    std::size_t const n = photons.size();
    if (n <= count) return 0;
    std::vector<float> radius, distance2(n);
    for (std::size_t k = 0; k < asked; ++k) {
        Vector const& p = photons.photon[(2 * k + 1) * n / (2 * asked)].position;
        for (std::size_t i = 0; i < n; ++i) distance2[i] = (photons.photon[i].position - p).squaredNorm();
        auto const wanted = distance2.begin() + static_cast<std::ptrdiff_t>(count);
        std::nth_element(distance2.begin(), wanted, distance2.end());
        radius.push_back(std::sqrt(*wanted));
    }
    std::nth_element(radius.begin(), radius.begin() + asked / 2, radius.end());
    return radius[asked / 2];
}

}  // namespace iride
