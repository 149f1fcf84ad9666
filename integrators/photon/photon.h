// SPDX-License-Identifier: Apache-2.0
// Photons where they fell: on every surface that scatters other than by Dirac lobes, after at least one scattering.
// Light that comes straight from a lamp is no photon: it is found by light sampling.
#pragma once

#include <cstdint>
#include <vector>

#include "scene/light_emission.h"
#include "scene/shape.h"

namespace iride {

struct Photon {
    Vector position;
    Direction normal;    // geometric, on the side that it came to
    Direction wi;        // where it came from
    Shape const* shape;  // that it fell on; of a map: null if its light may reach others
    std::uint16_t packet;
    std::uint16_t scatterings;
    bool can_be_followed;  // back to its last other scattering than by Dirac lobes, or to a lamp that can be met
};

// Power of the light that a photon stands for [W/nm], divided by the photons emitted with its packet; and the density
// per lane of its path, as PathState has them.
struct PhotonPower {
    Flux flux;
    Lanes reach;
};

struct PhotonList {
    std::vector<Photon> photon;
    std::vector<PhotonPower> power;

    std::size_t size() const { return photon.size(); }
    void append(PhotonList const& other) {
        photon.insert(photon.end(), other.photon.begin(), other.photon.end());
        power.insert(power.end(), other.power.begin(), other.power.end());
    }
};

// By their way since the lamp: mirrors and glass alone, or at least one other scattering. Each kind of path is in one
// of the two, so none is counted twice.
struct PhotonHarvest {
    PhotonList caustic, indirect;
};

}  // namespace iride
