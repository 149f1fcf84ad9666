// SPDX-License-Identifier: Apache-2.0
// The wavelengths of one path. Lane 0 is the hero; lane i is the hero's rotation by i / lane_count in the unit interval
// that is mapped to wavelengths, so every lane is equally likely to have been the hero and each is distributed with the
// same density p(lambda). The packet is const for the whole path. [Wilkie 2014]
#pragma once

#include <cstdint>
#include <cstring>
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

// table[cell] and table[cell + 1] of each lane. The two are one load of eight bytes: half the instructions of single
// numbers.
struct CellEnds {
    LaneRegister low, high;
};
template <class Index>
CellEnds ends_of_cells(float const* table, Index cell) {
    CellEnds ends;
    if constexpr (sizeof(Index) == 8 * sizeof(float)) {
        using Four = double __attribute__((vector_size(4 * sizeof(double))));
        using Eight = float __attribute__((vector_size(8 * sizeof(float))));
        auto const both = [&](int lane) {
            double bits;
            std::memcpy(&bits, table + cell[lane], sizeof bits);
            return bits;
        };
        Four const a{both(0), both(1), both(4), both(5)}, b{both(2), both(3), both(6), both(7)};
        auto const x = reinterpret_cast<Eight>(a), y = reinterpret_cast<Eight>(b);
        ends.low = __builtin_shuffle(x, y, Index{0, 2, 8, 10, 4, 6, 12, 14});
        ends.high = __builtin_shuffle(x, y, Index{1, 3, 9, 11, 5, 7, 13, 15});
    } else {
        for (int i = 0; i < lane_count; ++i) ends.low[i] = table[cell[i]], ends.high[i] = table[cell[i] + 1];
    }
    return ends;
}

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
    std::vector<float> density_;  // [segment_count], from knots that floats may not tell apart
};

// The default importance for XYZ: where the observer sees, and smooth, so that the lanes of a packet average well.
SpectralFunction visible_importance();

}  // namespace iride
