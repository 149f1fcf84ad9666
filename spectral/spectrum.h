// SPDX-License-Identifier: Apache-2.0
// A spectral quantity of dimension D, ready for the sampling loop: linear interpolation on the render's 1 nm grid, the
// grid cell and fraction of each lane being found once per path. A table whose knots are not whole nanometres is
// resampled; the error is at most a quarter of the change of slope [per nm] at the knot.
#pragma once

#include <vector>

#include "spectral/sampled.h"
#include "spectral/spectral_function.h"
#include "spectral/wavelengths.h"

namespace iride {

template <Dimension D>
class Spectrum {
  public:
    Spectrum() : Spectrum(0.0f) {}
    explicit Spectrum(float constant) : constant_(constant) {}
    Spectrum(SpectralFunction const& function, WavelengthGrid const& grid);

    Sampled<D> at(Wavelengths const& wavelengths) const {
        if (table_.empty()) return Sampled<D>(constant_);
        auto const [low, high] = ends_of_cells(table_.data(), wavelengths.cell);
        return Sampled<D>(low + wavelengths.fraction * (high - low));
    }

    bool is_constant() const { return table_.empty(); }

  private:
    std::vector<float> table_;  // [grid.count]; empty for a constant
    float constant_ = 0;
};

template <Dimension D>
Spectrum<D>::Spectrum(SpectralFunction const& function, WavelengthGrid const& grid) {
    if (function.is_constant()) {
        constant_ = static_cast<float>(function.at(0));
        return;
    }
    table_.reserve(static_cast<std::size_t>(grid.count));
    for (int i = 0; i < grid.count; ++i) table_.push_back(static_cast<float>(function.at(grid.first_nm + i)));
}

using Reflectance = Spectrum<dim::none>;
using Index = Spectrum<dim::none>;
using Emission = Spectrum<dim::spectral_radiance>;

}  // namespace iride
