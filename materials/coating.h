// SPDX-License-Identifier: Apache-2.0
// A coated metal for the sampling loop: the unpolarised reflectance of a thin-film stack, tabulated over wavelength and
// sqrt(cosine), linear between. The steps are halved until the middle of every cell is right to `coating_tolerance`.
// sqrt(cosine): near grazing, where metals change fastest, its steps are the finest.
#pragma once

#include <vector>

#include "materials/thin_film.h"
#include "spectral/complex_index.h"
#include "spectral/wavelengths.h"

namespace iride {

inline constexpr std::size_t max_coating_layers = 32;
inline constexpr double coating_tolerance = 5e-4;  // of reflectance, in each of the two directions of the table

struct CoatingLayer {
    ComplexIndex index;
    double thickness_nm;
};

// Layers from outside to inside, in air (n = 1). Unpolarised.
double coated_reflectance(std::span<CoatingLayer const> layers, ComplexIndex const& substrate, double wavelength_nm,
                          double cosine);

class CoatingTable {
  public:
    // Throws InputError where interference changes too fast with wavelength or angle to be tabulated: for layers too
    // thick to be coherent.
    CoatingTable(std::span<CoatingLayer const> layers, ComplexIndex const& substrate, WavelengthGrid const& grid);

    struct Place {
        LaneIndex row;
        LaneRegister fraction;
    };
    Place at(Wavelengths const& wavelengths) const;
    // cosine in [0, 1].
    Lanes reflectance(Place const& place, float cosine) const;

    int rows() const { return rows_; }
    int columns() const { return columns_; }

  private:
    int rows_, columns_;        // points in wavelength, in sqrt(cosine)
    int rows_per_nm_;           // a power of two
    std::vector<float> value_;  // [columns][rows]
};

// The Fresnel term of a coated conductor at the packet's wavelengths.
struct CoatedFresnel {
    CoatingTable const* table;  // of the material, which outlives every path
    CoatingTable::Place place;

    Lanes operator()(float cosine) const { return table->reflectance(place, cosine); }
};

inline CoatingTable::Place CoatingTable::at(Wavelengths const& w) const {
    Place place;
    for (int i = 0; i < lane_count; ++i) {
        float const within = w.fraction[i] * static_cast<float>(rows_per_nm_);
        int const step = std::min(static_cast<int>(within), rows_per_nm_ - 1);
        place.row[i] = w.cell[i] * rows_per_nm_ + step;
        place.fraction[i] = within - static_cast<float>(step);
    }
    return place;
}

inline Lanes CoatingTable::reflectance(Place const& place, float cosine) const {
    float const x = std::sqrt(cosine) * static_cast<float>(columns_ - 1);
    int const column = std::min(static_cast<int>(x), columns_ - 2);
    float const u = x - static_cast<float>(column);
    float const* const left = value_.data() + static_cast<std::size_t>(column) * static_cast<std::size_t>(rows_);
    float const* const right = left + rows_;
    Lanes result;
    for (int i = 0; i < lane_count; ++i) {
        int const row = place.row[i];
        float const lower = left[row] + u * (right[row] - left[row]);
        float const upper = left[row + 1] + u * (right[row + 1] - left[row + 1]);
        result.lane[i] = lower + place.fraction[i] * (upper - lower);
    }
    return result;
}

}  // namespace iride
