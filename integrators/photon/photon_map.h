// SPDX-License-Identifier: Apache-2.0
// Radiance from the density of photons around a point: with flux Phi_p of the photons within r of it,
//   L(wo) = sum_p f(wo, w_p) Phi_p |w_p.n_s| / |w_p.n_g| / (pi r^2)                         [Jensen 2001, sec. 7.2]
// r is R or, where k photons are nearer, the distance of the k-th of them; then the k - 1 nearer ones count, which
// makes the mean right for an even density. A share c < 1 of that radius looks at the photons within c r alone: given
// r, those within it lie in it as the density has them, so that the mean gets right for any density as c falls, for
// fixed k. Photons are counted only if they lie on the tangent plane, nearly, and came to the same side.
#pragma once

#include "integrators/photon/narrow.h"
#include "integrators/photon/photon.h"
#include "integrators/photon/photon_grid.h"
#include "integrators/scattering.h"

namespace iride {

// How wide to look.
struct Neighbourhood {
    float radius = 0;    // R [m]
    int neighbours = 2;  // k, of all packets
    float share = 1;     // c
};

// Where radiance along a camera path is wanted.
struct GatherPoint {
    Hit const& hit;
    Interaction const& here;
    PathState const& state;
    Direction const& side;  // geometric normal on the viewer's side
    bool both_sides;        // light may come through the surface
    int packet;
    int scatterings;  // of the camera path before this point
    int max_scatterings;
    Narrowness narrow;  // directions that the camera path follows
};

class PhotonMap {
  public:
    PhotonMap() = default;
    PhotonMap(PhotonList photons, float cell);

    std::size_t size() const { return photons_.size(); }
    PhotonList const& photons() const { return photons_; }

    // What the photons of the path's packet bring along it, weight and reach of the path included.
    Radiance brought(GatherPoint const& at, Neighbourhood const& around) const;

  private:
    // What a photon sends along the path, before the division by an area.
    Flux scattered(GatherPoint const& at, std::uint32_t index) const;

    PhotonList photons_;
    PhotonGrid grid_;
};

// Median over photons of the distance to the count-th nearest one [m], from some of them; 0 if there are too few.
float median_distance(PhotonList const& photons, std::size_t count);

}  // namespace iride
