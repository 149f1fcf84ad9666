// SPDX-License-Identifier: Apache-2.0
// iride plan SCENE: what the scene needs, what is skipped, and why.
#include <fmt/format.h>

#include <memory>

#include "app/command.h"
#include "app/vanishing_points.h"
#include "integrators/plan.h"

namespace iride {

namespace {

int print_plan(std::string const& name) {
    auto const scene = load_scene(find_scene(name));
    RenderPlan const plan = make_plan(*scene);
    fmt::print("{}: {}\n", scene->name, scene->description);
    fmt::print("  {} shapes, {} materials, {} lights, {} x {} pixels\n\n", scene->shapes.size(),
               scene->materials.size(), scene->lights.size(), scene->film.width, scene->film.height);
    for (RenderPlan::Decision const& d : plan.decisions)
        fmt::print("  {:<8}{:<18}{}\n", d.used ? "used" : "skipped", d.name, d.reason);
    fmt::print("\n{}\n", vanishing_points(*scene));
    for (std::string const& remark : scene->remarks) fmt::print("  note    {}\n", remark);
    return exit_done;
}

}  // namespace

Command add_plan(CLI::App& app) {
    CLI::App* const parser = app.add_subcommand("plan", "What a scene needs, what is skipped, and why");
    auto const scene = std::make_shared<std::string>();
    parser->add_option("SCENE", *scene, "a scene file or the name of a shipped scene")->required();
    return {parser, [scene] { return print_plan(*scene); }};
}

}  // namespace iride
