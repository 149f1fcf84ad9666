// SPDX-License-Identifier: Apache-2.0
// What photons know of the light: a caustic and an indirect map, and lamps sampled directly. A map is made once, each
// photon spread over a disc that holds k, or for each pass anew, over a share of that disc's radius that shrinks so
// that bias and noise both vanish:
//   c_{i+1}^2 = c_i^2 (i + alpha) / (i + 1),  so  c_i^2 = Gamma(i + alpha) / (Gamma(1 + alpha) i!)
//                                                             [Hachisuka 2009] [Knaus 2011, eq. 16]
// Each pass is a function of (seed, number of the pass) alone, of the others only the widest radius is known.
#pragma once

#include "integrators/photon/packets.h"
#include "integrators/photon/photon_tracer.h"
#include "integrators/photon/plane_reach.h"
#include "integrators/photon/radiance_cache.h"

namespace iride {

struct PhotonSettings {
    int photons = 200000;  // emitted, of a map
    int neighbours = 100;
    double radius = 0;         // m: the most; 0: found from the first map
    double alpha = 2.0 / 3;    // 0 .. 1; of shrinking shares
    double narrow = 2;         // T of Narrowness
    int packets = 16;          // M; of a progressive one also the samples of a pass
    bool progressive = false;  // a map for each pass
};

class PhotonCache final : public RadianceCache {
  public:
    PhotonCache(Scene const& scene, RenderPlan const& plan, PhotonSettings const& settings);

    void prepare(Scene const& scene, SamplePass const& pass, RayStatistics& statistics);
    PacketSet const& packets() const { return *packets_; }
    PhotonMap const& caustic() const { return caustic_; }
    PhotonMap const& indirect() const { return indirect_; }

    Radiance all(CachedPoint const& point) const override;
    bool has_narrow() const override { return false; }
    Radiance direct_and_caustic(CachedPoint const& point) const override;

    // c_i^2, i = 1, 2, ...
    static double shrinkage(int i, double alpha);

  private:
    void shoot(Scene const& scene, std::uint64_t seed, int map, RayStatistics& statistics);
    float widest_radius(PhotonList const& photons, float widest) const;

    PhotonSettings settings_;
    WavelengthSampler wavelengths_;
    int max_scatterings_;
    LightSurroundings lamps_in_;
    PlaneReach reach_;
    std::optional<std::uint64_t> seed_;
    std::optional<int> made_;  // number of the map at hand
    float caustic_widest_ = 0, indirect_widest_ = 0;
    std::optional<PacketSet> packets_;
    PhotonMap caustic_, indirect_;
};

}  // namespace iride
