// SPDX-License-Identifier: Apache-2.0
// The wavelengths of one path. Lane 0 is the hero; lane i is the hero's rotation by i / lane_count in the unit interval
// that is mapped to wavelengths, so every lane is equally likely to have been the hero and each is distributed with the
// same density p(lambda). The packet is const for the whole path. [Wilkie 2014]
#pragma once

#include <cstdint>
#include <vector>

#include "spectral/sampled.h"
#include "spectral/spectral_function.h"

namespace iride {

// The common 1 nm grid on which a render's spectra are tabulated: first_nm, first_nm + 1, ..., `count` points.
struct WavelengthGrid {
    int first_nm, count;
    static WavelengthGrid covering(WavelengthRange const& range);
};

using LaneIndex = std::int32_t __attribute__((vector_size(lane_count * sizeof(std::int32_t))));

struct Wavelengths {
    LaneRegister nm;
    Sampled<dim::per_nanometre> density;  // p(lambda) of each lane
    LaneIndex cell;                       // grid cell that holds the lane ...
    LaneRegister fraction;                // ... and the place in it, 0..1
};

// A packet at wavelengths of one's own, to look spectra up outside the sampling loop. Its density is 1 per nm.
Wavelengths wavelengths_at(LaneRegister const& nm, WavelengthGrid const& grid);

// Draws packets from a density p(lambda) on a range. The map u -> lambda is piecewise linear over `segment_count` equal
// steps of u, so that sampling needs no search and the density is its exact derivative: p = 1 / (segment_count width).
class WavelengthSampler {
  public:
    // `importance`: the wanted density, up to a factor; its zeros are lifted to a floor so that every wavelength of the
    // range is reached.
    WavelengthSampler(WavelengthRange const& range, SpectralFunction const& importance, WavelengthGrid const& grid);

    static constexpr int segment_count = 1024;  // a multiple of every lane count, so that lanes share the fraction

    Wavelengths sample(float u) const;
    WavelengthRange const& range() const { return range_; }

  private:
    WavelengthRange range_;
    int grid_first_nm_, grid_cells_;
    std::vector<float> knot_nm_;  // [segment_count + 1]
};

// The default importance for XYZ: where the observer sees, and smooth, so that the lanes of a packet average well.
SpectralFunction visible_importance();

}  // namespace iride
