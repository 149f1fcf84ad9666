// SPDX-License-Identifier: Apache-2.0
// The wavelengths of photons and of the paths that gather them. A map has M packets; photon n carries packet n mod M,
// and a camera path draws one of them and gathers the photons of that packet alone.
//   u_j = (j + xi) / M,  xi uniform in [0, 1) for a map, packet j = packet at u_j           [Wilkie 2014 for the
//   packet]
// Unbiased in wavelength, without a kernel: for given xi, a photon's flux is divided by the number emitted with its
// packet, N / M, so the photons of packet j have the mean E(lambda_ji) of the light that is sought in each of its
// lanes, and the camera path brings (1/M) sum_j (1/lanes) sum_i E(lambda_ji) observer(lambda_ji) / p(lambda_ji) in the
// mean; u_j with j and xi uniform is uniform, so the mean over xi is the integral over wavelength. With the samples of
// a pixel each packet has its turn, so that all photons are used; the lanes of all packets are M times eight evenly
// spaced points of the unit interval. Dispersion: photon and camera path that meet have the same hero; their path as
// one was drawn with density mean over lanes of reach_photon reach_camera, relative to the hero's, and is divided by
// it.
#pragma once

#include <vector>

#include "base/random.h"
#include "spectral/wavelengths.h"

namespace iride {

class PacketSet {
  public:
    PacketSet(WavelengthSampler const& sampler, int count, std::uint64_t key) {
        float const shift = to_unit_float(static_cast<std::uint32_t>(hash_words(key)));
        for (int j = 0; j < count; ++j)
            packet_.push_back(sampler.sample((static_cast<float>(j) + shift) / static_cast<float>(count)));
    }
    int count() const { return static_cast<int>(packet_.size()); }
    Wavelengths const& packet(int j) const { return packet_[static_cast<std::size_t>(j)]; }
    // The packet that a random number stands for.
    int choose(float u) const { return std::min(static_cast<int>(u * static_cast<float>(count())), count() - 1); }

  private:
    std::vector<Wavelengths> packet_;
};

}  // namespace iride
