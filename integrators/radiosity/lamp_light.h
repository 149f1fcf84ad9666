// SPDX-License-Identifier: Apache-2.0
// What a lamp brings to a place among patches, at evenly spaced wavelengths: an estimate by one point of one lamp,
//   E = cos L / (p_lamp p_direction)    [W m^-2 nm^-1].
#pragma once

#include "integrators/plan.h"
#include "integrators/radiosity/patches.h"

namespace iride::radiosity {

class LampLight {
  public:
    using Spectrum = Eigen::Array<float, 1, Eigen::Dynamic>;

    LampLight(Scene const& scene, RenderPlan const& plan, PatchTracer const& tracer,
              std::vector<double> const& wavelengths_nm);

    // Irradiance of a place of a patch with this normal; `irradiance` has an entry for each wavelength. False: none.
    bool ask(VectorDouble const& place, VectorDouble const& normal, float which, Sample2 where,
             Spectrum& irradiance) const;

  private:
    Scene const& scene_;
    PatchTracer const& tracer_;
    LightSelector selector_;
    std::vector<Wavelengths> packets_;
};

}  // namespace iride::radiosity
