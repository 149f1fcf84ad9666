// SPDX-License-Identifier: Apache-2.0
// Rough diffuse materials, as a scene file gives them.
#include "materials/oren_nayar_material.h"
#include "scene/material_readers.h"
#include "scene/texture_readers.h"

namespace iride {

MaterialPointer read_oren_nayar(SceneBuilder& b, Fields& f) {
    auto const reflectance = read_reflectance_map(b, f, "reflectance");
    double const roughness = f.required_number("roughness", between(0, 1));
    if (!reflectance) return nullptr;
    return std::make_unique<OrenNayarMaterial>(*reflectance, static_cast<float>(roughness));
}

}  // namespace iride
