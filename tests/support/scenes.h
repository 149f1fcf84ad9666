// SPDX-License-Identifier: Apache-2.0
// Small scenes as text, rendered in the test's own process.
#pragma once

#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "film/compare.h"
#include "integrators/render.h"

namespace iride::test {

// A folder that is gone with the test.
class TemporaryFolder {
  public:
    TemporaryFolder() {
        std::string name = (std::filesystem::temp_directory_path() / "iride-test-XXXXXX").string();
        path_ = ::mkdtemp(name.data());
    }
    ~TemporaryFolder() {
        std::error_code ignored;
        std::filesystem::remove_all(path_, ignored);
    }
    TemporaryFolder(TemporaryFolder const&) = delete;
    TemporaryFolder& operator=(TemporaryFolder const&) = delete;

    std::filesystem::path write(std::string const& name, std::string const& content) const {
        std::ofstream(path_ / name, std::ios::binary) << content;
        return path_ / name;
    }
    std::filesystem::path const& path() const { return path_; }

  private:
    std::filesystem::path path_;
};

inline std::unique_ptr<Scene> scene_from(std::string const& text) {
    TemporaryFolder const folder;
    return load_scene(folder.write("scene.json", text));
}

inline Film rendered(Scene const& scene, std::string const& integrator, RenderSettings const& settings) {
    RenderPlan const plan = make_plan(scene);
    Film film = make_film(scene);
    render(scene, plan, *make_integrator(integrator, scene, plan), settings, film);
    return film;
}

}  // namespace iride::test
