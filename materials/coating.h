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

    // Where the packet's wavelengths lie in the table, counted in rows. One register, for the closure's size; in single
    // precision the place is right to 1/1000 row, the reflectance to 1e-4.
    LaneRegister row_of(Wavelengths const& wavelengths) const;
    // cosine in [0, 1]; below it, or NaN, as 0: no reading outside the table.
    Lanes reflectance(LaneRegister row, float cosine) const;

    // 2 int R mu dmu at a wavelength that many nanometres from the grid's first.
    double mean_reflectance(double nm) const;

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
    LaneRegister row;

    Lanes operator()(float cosine) const { return table->reflectance(row, cosine); }
};

inline LaneRegister CoatingTable::row_of(Wavelengths const& w) const {
    return (__builtin_convertvector(w.cell, LaneRegister) + w.fraction) * static_cast<float>(rows_per_nm_);
}

inline Lanes CoatingTable::reflectance(LaneRegister row, float cosine) const {
    float const x = std::sqrt(std::max(0.0f, cosine)) * static_cast<float>(columns_ - 1);
    int const column = std::min(static_cast<int>(x), columns_ - 2);
    float const u = x - static_cast<float>(column);
    float const* const left = value_.data() + static_cast<std::size_t>(column) * static_cast<std::size_t>(rows_);
    float const* const right = left + rows_;
    Lanes result;
    for (int i = 0; i < lane_count; ++i) {
        int const cell = std::min(static_cast<int>(row[i]), rows_ - 2);
        float const lower = left[cell] + u * (right[cell] - left[cell]);
        float const upper = left[cell + 1] + u * (right[cell + 1] - left[cell + 1]);
        result.lane[i] = lower + (row[i] - static_cast<float>(cell)) * (upper - lower);
    }
    return result;
}

}  // namespace iride
