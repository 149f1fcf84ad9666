// SPDX-License-Identifier: Apache-2.0
// iride radiosity SCENE: patches, form factors and the solution for every wavelength, as a summary or as JSON.
#include "integrators/radiosity/radiosity.h"

#include <fmt/format.h>

#include <chrono>
#include <memory>
#include <nlohmann/json.hpp>

#include "app/command.h"

namespace iride {

namespace {

using namespace radiosity;

struct Options {
    std::string scene;
    Settings settings;
    bool json = false;
};

void print_json(Scene const& scene, SceneRadiosity const& solution, Settings const& settings) {
    nlohmann::ordered_json patches = nlohmann::ordered_json::array();
    Eigen::ArrayXXd const b = solution.radiosity();
    for (std::size_t i = 0; i < solution.mesh().patch.size(); ++i) {
        Patch const& p = solution.mesh().patch[i];
        Shape const& shape = *solution.mesh().shape[static_cast<std::size_t>(p.shape)];
        auto const row = b.row(static_cast<Eigen::Index>(i));
        patches.push_back(
            {{"name", fmt::format("{}.{}{}.{}", p.shape, scene.materials[static_cast<std::size_t>(shape.material)].name,
                                  p.back ? ".back" : "", i)},
             {"area_m2", p.area},
             {"radiosity_W_m2_nm", std::vector<double>(row.begin(), row.end())}});
    }
    nlohmann::ordered_json const out{{"wavelengths_nm", solution.wavelengths_nm()},
                                     {"patches", std::move(patches)},
                                     {"form_factors",
                                      {{"method", settings.form_factors},
                                       {"reciprocity_defect", solution.report().reciprocity_defect},
                                       {"closure_defect", solution.report().closure_defect}}},
                                     {"solver", settings.solver},
                                     {"iterations", solution.report().iterations},
                                     {"residual", solution.report().residual}};
    fmt::print("{}\n", out.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace));
}

void print_summary(SceneRadiosity const& solution, Settings const& settings, double seconds) {
    Report const& r = solution.report();
    fmt::print("{} patches, {} wavelengths, {:.2f} s\n", solution.mesh().patch.size(), solution.wavelengths_nm().size(),
               seconds);
    fmt::print("form factors ({}): reciprocity defect {:.2g}, closure defect {:.2g}\n", settings.form_factors,
               r.reciprocity_defect, r.closure_defect);
    fmt::print("{}: {} iterations, residual {:.2g}\n", settings.solver, r.iterations, r.residual);
}

int run(Options const& o) {
    auto const scene = load_scene(find_scene(o.scene));
    RenderPlan const plan = make_plan(*scene);
    auto const start = std::chrono::steady_clock::now();
    SceneRadiosity const solution(*scene, plan.wavelengths, o.settings);
    if (o.json)
        print_json(*scene, solution, o.settings);
    else
        print_summary(solution, o.settings,
                      std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
    for (std::string const& remark : solution.report().remarks) fmt::print(stderr, "note: {}\n", remark);
    return exit_done;
}

template <class Table>
std::string listing(Table const& table) {
    std::string text;
    for (auto const& e : table) text += fmt::format("\n  {}: {}", e.name, e.summary);
    return text;
}

}  // namespace

Command add_radiosity(CLI::App& app) {
    CLI::App* const parser =
        app.add_subcommand("radiosity", "Solve a scene's diffuse light for every wavelength, patch by patch");
    auto const o = std::make_shared<Options>();
    Settings& s = o->settings;
    parser->add_option("SCENE", o->scene, "a scene file or the name of a shipped scene")->required();
    parser->add_option("--form-factors", s.form_factors, "how patches see each other:" + listing(form_factor_methods()))
        ->capture_default_str();
    parser->add_option("--fineness", s.fineness, "rays, cells of an edge or lines of that method (default: its own)")
        ->check(CLI::Range(1, 1 << 20));
    parser->add_option("--solver", s.solver, "one of:" + listing(solvers()))->capture_default_str();
    parser->add_option("--iterations", s.stop.iterations, "the most steps of the solver")
        ->check(CLI::Range(1, 1 << 30))
        ->capture_default_str();
    parser->add_option("--tolerance", s.stop.tolerance, "largest residual over the largest emission to stop at")
        ->check(CLI::Range(1e-15, 1.0))
        ->capture_default_str();
    parser->add_option("--size", s.size_m, "longest edge of a patch in metres (default: about 2500 patches)")
        ->check(CLI::PositiveNumber);
    parser->add_option("--wavelengths", s.wavelengths, "how many, evenly spaced where lamps and observer overlap")
        ->check(CLI::Range(1, 1000))
        ->capture_default_str();
    parser->add_flag("--json", o->json, "print every patch with its spectrum as JSON");
    return {parser, [o] { return run(*o); }};
}

}  // namespace iride
