// SPDX-License-Identifier: Apache-2.0
// The readers of the material families, for the table in material_reader.cpp. Null after an error.
#pragma once

#include "scene/readers.h"

namespace iride {

using MaterialPointer = std::unique_ptr<Material const>;

MaterialPointer read_diffuse(SceneBuilder& builder, Fields& fields);
MaterialPointer read_black(SceneBuilder& builder, Fields& fields);
MaterialPointer read_conductor(SceneBuilder& builder, Fields& fields);
MaterialPointer read_dielectric(SceneBuilder& builder, Fields& fields);

}  // namespace iride
