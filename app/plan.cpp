// SPDX-License-Identifier: Apache-2.0
// iride plan SCENE: what the scene needs, what is skipped, and why.
#include <fmt/format.h>

#include <memory>

#include "app/command.h"
#include "app/vanishing_points.h"
#include "integrators/layers.h"
#include "integrators/plan_disable.h"

namespace iride {

namespace {

struct Options {
    std::string scene;
    std::vector<std::string> disabled;
};

int print_plan(Options const& o) {
    auto const scene = load_scene(find_scene(o.scene));
    RenderPlan const plan = make_plan_without(o.disabled, *scene);
    check_layers(scene->film.aovs, *scene, plan, scene->render.integrator.name, false);
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

void add_plan_disable(CLI::App& parser, std::vector<std::string>& disabled) {
    std::string names;
    for (PlanSwitch const& s : plan_switches())
        names += fmt::format("\n  {}: {}{}", s.name, s.instead, s.same_picture ? "" : " (the same in the mean alone)");
    parser
        .add_option("--plan-disable", disabled,
                    "switch a decision of the plan off, to see what it saves; may be repeated:" + names)
        ->allow_extra_args(false);
}

Command add_plan(CLI::App& app) {
    CLI::App* const parser = app.add_subcommand("plan", "What a scene needs, what is skipped, and why");
    auto const o = std::make_shared<Options>();
    parser->add_option("SCENE", o->scene, "a scene file or the name of a shipped scene")->required();
    add_plan_disable(*parser, o->disabled);
    return {parser, [o] { return print_plan(*o); }};
}

}  // namespace iride
