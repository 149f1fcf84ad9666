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
MaterialPointer read_slab(SceneBuilder& builder, Fields& fields);

// What fills a transparent body: the index under `key`, its k and the keys "absorption", "absorption_per_m".
std::optional<Medium> read_medium(SceneBuilder& builder, Fields& fields, std::string const& key);
// The same of the index alone.
std::optional<Medium> read_medium_of_index(SceneBuilder& builder, Fields& fields, std::string const& key);

}  // namespace iride
