// SPDX-License-Identifier: Apache-2.0
// Everything colorimetry says about one spectrum: what `iride colour spectrum` prints.
#pragma once

#include <optional>

#include "colour/chromaticity.h"
#include "colour/lab.h"
#include "colour/luv.h"
#include "colour/planckian_locus.h"
#include "colour/spectral_locus.h"
#include "colour/tristimulus.h"

namespace iride {

// Y = 100 for the perfect diffuser or the light itself. Absent: what the colour does not have (black has no
// chromaticity, a purple no dominant wavelength, a colour out of range no correlated temperature).
struct ColourDescription {
    Xyz xyz;
    std::optional<Chromaticity> xy;
    std::optional<UvPrime> uv_prime;
    Luv luv;
    Lab lab;
    std::optional<double> dominant_wavelength_nm, complementary_wavelength_nm;
    double excitation_purity;
    std::optional<double> cct_K, duv;
};

// Describes colours seen by one observer under one illuminant, whose colour is the white of L*u*v*, L*a*b* and of the
// dominant wavelength. Made once, used for many spectra.
class ColourDescriber {
  public:
    ColourDescriber(SpectralFunction const& illuminant, Observer const& observer);

    // A reflectance factor or transmittance under the illuminant: `linear` between its points, as the renderer carries
    // it, or with the weights of ASTM E2022 where it was measured at 5, 10 or 20 nm. Throws InputError if it is not
    // within 0 .. 1 (it may be percent) or has no wavelength in the observer's domain.
    enum class Between { linear, astm };
    ColourDescription of_object(SpectralFunction const& factor, Between between = Between::linear) const;
    // A light by itself, whatever its power.
    ColourDescription of_light(SpectralFunction const& power) const;
    // XYZ with Y = 100 for the white.
    ColourDescription of(Xyz const& colour) const;

    Xyz white() const { return 100 * weights_.white(); }

  private:
    Observer const& observer_;
    TristimulusWeights weights_;
    SpectralLocus spectral_locus_;
    PlanckianLocus planckian_locus_;
};

// Refuses what is no reflectance or transmittance: values outside 0 .. 1 (percent?), nothing within `domain`.
void check_factor(SpectralFunction const& factor, WavelengthRange const& domain);

}  // namespace iride
