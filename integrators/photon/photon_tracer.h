// SPDX-License-Identifier: Apache-2.0
// Emission and scattering of photons. A photon starts with Le cos / (p_light p_A p_w N) and keeps, by roulette on what
// its path lets through, about the same power [Jensen 2001, ch. 5]. Power is scattered by the BSDF read backwards: with
// w where it comes from, v where it goes,
//   f(v, w) |v.n_g| |w.n_s| / |w.n_g| / p(v),  and through a Dirac boundary the weight of a viewer's ray (n_v / n_w)^2
// times that of shading normals, as radiance is scaled there and power is not.           [Veach 1997, sec. 5.2, 5.3]
#pragma once

#include "integrators/light_surroundings.h"
#include "integrators/photon/packets.h"
#include "integrators/photon/photon.h"
#include "integrators/plan.h"

namespace iride {

struct PhotonShot {
    std::uint64_t key;    // of the random numbers
    int photons;          // emitted, of each packet
    int max_scatterings;  // a photon is not stored after more
    LightSurroundings const& lamps_in;
};

// All photons, in the order of their emission whatever the threads. Counts rays.
PhotonHarvest shoot_photons(Scene const& scene, PacketSet const& packets, PhotonShot const& shot,
                            RayStatistics& statistics);

}  // namespace iride
