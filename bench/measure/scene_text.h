// SPDX-License-Identifier: Apache-2.0
// A scene from its text, for what is made up on the spot.
#pragma once

#include "base/temporary_folder.h"
#include "scene/scene.h"

namespace iride::bench {

inline std::unique_ptr<Scene> scene_from(std::string const& text) {
    TemporaryFolder const folder;
    return load_scene(folder.write("scene.json", text));
}

}  // namespace iride::bench
