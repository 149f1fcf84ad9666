// SPDX-License-Identifier: Apache-2.0
// Parameters of a material that may vary over its surface.
#pragma once

#include "materials/surface_point.h"
#include "spectral/spectrum.h"

namespace iride {

class ReflectanceMap {
  public:
    ReflectanceMap(Reflectance everywhere) : everywhere_(std::move(everywhere)) {}
    Lanes at(SurfacePoint const&, Wavelengths const& wavelengths) const { return everywhere_.at(wavelengths); }

  private:
    Reflectance everywhere_;
};

}  // namespace iride
