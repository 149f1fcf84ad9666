// SPDX-License-Identifier: Apache-2.0
// Readers of what may vary over a surface, for the readers of materials. Nothing after an error, which is reported.
#pragma once

#include "materials/relief.h"
#include "scene/readers.h"

namespace iride {

// The reflectance under `key` (required): a spectrum, or a texture of them.
std::optional<ReflectanceMap> read_reflectance_map(SceneBuilder& builder, Fields& fields, std::string const& key);

// What the numbers of a map are.
struct ScalarRole {
    char const* name;  // "roughness", as "role" says it
    Limits limits;     // of the values
};
// The number or map under `key`; absent: nothing, and no error.
std::optional<ScalarMap> read_scalar_map(SceneBuilder& builder, Fields& fields, std::string const& key,
                                         ScalarRole const& role);

// The keys that every material has: "bump", "normal_map" and "alpha".
struct SurfaceDetail {
    std::shared_ptr<Relief const> relief;
    std::optional<ScalarMap> alpha;
};
SurfaceDetail read_surface_detail(SceneBuilder& builder, Fields& fields);

}  // namespace iride
