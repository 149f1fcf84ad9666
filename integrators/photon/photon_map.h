// SPDX-License-Identifier: Apache-2.0
// Radiance from the photons whose discs reach over a point x, each as wide as photons are sparse where it lies:
//   L(wo) = sum_p f(wo, w_p) Phi_p |w_p.n_s| / |w_p.n_g| K(|x - x_p| / r_p) / (pi r_p^2),  K(t) = 2 (1 - t^2)
//   pi r_p^2 = A_k, the part on the surface of the disc about photon p on whose edge its k-th neighbour lies
//                                                  [Jensen 2001, sec. 7.2] [Silverman 1986, sec. 2.6, 5.3]
// A photon's power is spread, not changed: the flux of the light is kept, at the edge of a caustic as well. That of the
// k nearest of x is not: it falls as 1 / distance^2 where there is no light. By E the irradiance, r_p^2 E is constant,
// so that the bias of order r^2, the laplacian of r^2 E, is none [Abramson 1982]. Where a disc reaches over an edge
// that is known, what lies beyond is folded back. A share c < 1 of the radii, falling from map to map, makes the mean
// right for fixed k. Photons are counted only if they lie on the tangent plane, nearly, and came to the same side.
#pragma once

#include "integrators/photon/disc_grid.h"
#include "integrators/photon/narrow.h"
#include "integrators/photon/photon.h"
#include "integrators/photon/plane_reach.h"
#include "integrators/scattering.h"

namespace iride {

// How wide discs are.
struct Spread {
    float widest = 0;    // [m]
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
    // `cell`: about the radius that holds k photons [m].
    PhotonMap(PhotonList photons, PlaneReach const& reach, Spread const& spread, float cell);

    std::size_t size() const { return photons_.size(); }
    PhotonList const& photons() const { return photons_; }

    // What the photons of the path's packet bring along it, weight and reach of the path included.
    Radiance brought(GatherPoint const& at) const;

  private:
    // What a photon sends along the path, before the division by an area.
    Flux scattered(GatherPoint const& at, std::uint32_t index) const;

    PhotonList photons_;
    DiscGrid discs_;
};

// Median over photons of the distance to the count-th nearest one [m], from some of them; 0 if there are too few.
float median_distance(PhotonList const& photons, std::size_t count);

}  // namespace iride
