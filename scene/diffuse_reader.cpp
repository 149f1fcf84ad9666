// SPDX-License-Identifier: Apache-2.0
// Opaque materials without a surface of their own, as a scene file gives them.
#include "materials/diffuse_material.h"
#include "scene/material_readers.h"
#include "scene/texture_readers.h"

namespace iride {

MaterialPointer read_diffuse(SceneBuilder& b, Fields& f) {
    auto const reflectance = read_reflectance_map(b, f, "reflectance");
    if (!reflectance) return nullptr;
    return std::make_unique<DiffuseMaterial>(*reflectance);
}

MaterialPointer read_black(SceneBuilder&, Fields&) { return std::make_unique<BlackMaterial>(); }

}  // namespace iride
