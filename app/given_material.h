// SPDX-License-Identifier: Apache-2.0
// Materials as `iride material` names them, and what they reflect by angle: an index of the catalogue or of a file is a
// plane surface in air; of a scene file a smooth metal, glass or film is its exact plane surface, and anything else
// (or what is rough) reflects its directional albedo, from the closure that the renderer uses.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "materials/plane_stack.h"
#include "scene/scene.h"

namespace iride {

struct GivenMaterial {
    std::string name, source;
    WavelengthRange defined_on;               // wavelengths that may be asked for
    std::optional<PlaneStack> plane = {};     // what its index is, and, if smooth, all of it
    std::shared_ptr<Scene const> scene = {};  // of the following
    Material const* material = nullptr;       // null: the plane alone
    bool smooth() const { return material == nullptr || (plane && !material->traits.has_density); }
};

// "Au", "Au:McPeak", "N-BK7", a file of n and k, "scene.json:material" or "scene.json" for all its named ones. Throws
// InputError: unknown name (with the nearest), bad file, no material.
std::vector<GivenMaterial> given_materials(std::string const& name);

// Light from outside. Absent: n and k of what has no index; Rs, Rp and T of what is rough or diffuse.
struct MaterialReflectance {
    std::optional<double> n, k, Rs, Rp;
    double R;
};
MaterialReflectance reflectance_of(GivenMaterial const& material, double angle_deg, double wavelength_nm);

// R alone at many wavelengths; beyond `defined_on` as at its end.
std::vector<double> reflectances(GivenMaterial const& material, double angle_deg,
                                 std::vector<double> const& wavelengths_nm);

}  // namespace iride
