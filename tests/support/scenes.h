// SPDX-License-Identifier: Apache-2.0
// Small scenes as text, rendered in the test's own process.
#pragma once

#include "base/temporary_folder.h"
#include "bench/measure/scene_text.h"
#include "film/compare.h"
#include "integrators/render.h"

namespace iride::test {

using iride::TemporaryFolder;

using bench::scene_from;

inline Film rendered(Scene const& scene, std::string const& integrator, RenderSettings const& settings) {
    RenderPlan const plan = make_plan(scene);
    Film film = make_film(scene);
    render(scene, plan, *make_integrator(integrator, scene, plan), settings, film);
    return film;
}

}  // namespace iride::test
