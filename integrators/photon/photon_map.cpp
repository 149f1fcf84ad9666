// SPDX-License-Identifier: Apache-2.0
#include "integrators/photon/photon_map.h"

#include <tbb/parallel_for.h>

#include "integrators/photon/photon_grid.h"
#include "integrators/photon/quad_edges.h"

namespace iride {

namespace {

// A photon lies on the plane through p if its height is below this share of its distance: surfaces curve, layers do not
// touch.
constexpr float flatness = 0.3f;
constexpr float alike = 0.8f;  // cosine between normals of one smooth surface, over the width of a disc

bool is_flat(Vector const& d, Direction const& normal) {
    constexpr float rounding = 1e-5f;  // m: two places on a plane, as floats
    return std::abs(d.dot(normal)) <= flatness * d.norm() + rounding;
}

// The radii of discs about photons.
class DiscRadii {
  public:
    DiscRadii(std::vector<Photon> const& photons, PlaneReach const& reach, Spread const& spread, float cell)
        : photons_(photons), reach_(reach), spread_(spread), grid_(entries(), cell) {}

    // Cell by cell: what neighbours look at is at hand.
    std::vector<float> all() const {
        std::vector<float> radius(photons_.size());
        auto const order = grid_.entries();
        tbb::parallel_for(std::size_t{0}, order.size(),
                          [&](std::size_t i) { radius[order[i].index] = of(photons_[order[i].index]); });
        return radius;
    }

  private:
    float of(Photon const& photon) const {
        thread_local std::vector<PhotonGrid::Neighbour> found;
        Quad const* const edges = reach_.edges(*photon.shape);
        auto const is_beside = [&](PhotonGrid::Entry const& e, float) {
            Photon const& other = photons_[e.index];
            return other.normal.dot(photon.normal) > alike && (!edges || other.shape == photon.shape) &&
                   is_flat(other.position - photon.position, photon.normal);
        };
        float const widest = std::min(spread_.widest, reach_.of(*photon.shape));
        // One more: the photon is a neighbour of its own.
        float const r2 =
            grid_.nearest(photon.position, widest, static_cast<std::size_t>(spread_.neighbours) + 1, is_beside, found);
        return spread_.share *
               (edges ? std::sqrt(disc_area_in_quad(*edges, photon.position, std::sqrt(r2)) / pi) : std::sqrt(r2));
    }

    std::vector<PhotonGrid::Entry> entries() const {
        std::vector<PhotonGrid::Entry> entries;
        entries.reserve(photons_.size());
        for (Photon const& p : photons_) entries.push_back({p.position, static_cast<std::uint32_t>(entries.size())});
        return entries;
    }

    std::vector<Photon> const& photons_;
    PlaneReach const& reach_;
    Spread const& spread_;
    PhotonGrid grid_;
};

}  // namespace

PhotonMap::PhotonMap(PhotonList photons, PlaneReach const& reach, Spread const& spread, float cell)
    : photons_(std::move(photons)) {
    std::vector<Photon>& photon = photons_.photon;
    if (photon.empty()) return;
    std::vector<float> const radius = DiscRadii(photon, reach, spread, cell).all();
    std::vector<DiscGrid::Disc> discs;
    for (std::size_t i = 0; i < photon.size(); ++i) {
        if (!(radius[i] > 0)) continue;
        auto const put = [&](Vector const& centre) {
            discs.push_back({centre, radius[i], photon[i].packet, static_cast<std::uint32_t>(i)});
        };
        put(photon[i].position);
        if (Quad const* const edges = reach.edges(*photon[i].shape))
            for_images(*edges, photon[i].position, radius[i], put);
        else
            photon[i].shape = nullptr;
    }
    discs_ = DiscGrid(discs);
}

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

Radiance PhotonMap::brought(GatherPoint const& at) const {
    Flux sum;  // per pi m^2
    discs_.visit(at.hit.point.position, static_cast<std::uint32_t>(at.packet),
                 [&](DiscGrid::Disc const& disc, float d2) {
                     Photon const& photon = photons_.photon[disc.index];
                     float const turned = photon.normal.dot(at.side), r2 = square(disc.radius);
                     if (!((at.both_sides ? std::abs(turned) : turned) > alike)) return;
                     if (!is_flat(disc.centre - at.hit.point.position, at.side)) return;
                     if (photon.shape && photon.shape != at.hit.shape) return;
                     sum += scattered(at, disc.index) * (2 * (1 - d2 / r2) / r2);
                 });
    return Radiance(sum.lane / pi);
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
