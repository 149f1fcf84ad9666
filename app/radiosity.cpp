// SPDX-License-Identifier: Apache-2.0
// iride radiosity SCENE: patches, form factors and the solution for every wavelength, as a summary or as JSON.

#include <fmt/format.h>

#include <memory>
#include <nlohmann/json.hpp>

#include "app/command.h"
#include "base/atomic_file.h"
#include "base/clock.h"
#include "integrators/radiosity/radiosity.h"
#include "integrators/radiosity/solution_file.h"

namespace iride {

namespace {

using namespace radiosity;

struct Options {
    std::string scene;
    Settings settings;
    std::string save;
    bool json = false;
};

void print_json(Scene const& scene, SceneRadiosity const& solution, Settings const& settings) {
    nlohmann::ordered_json patches = nlohmann::ordered_json::array();
    Eigen::ArrayXXd const b = solution.radiosity(), errors = solution.standard_error();
    for (std::size_t i = 0; i < solution.mesh().patch.size(); ++i) {
        Patch const& p = solution.mesh().patch[i];
        Shape const& shape = *solution.mesh().shape[static_cast<std::size_t>(p.shape)];
        auto const row = b.row(static_cast<Eigen::Index>(i));
        patches.push_back(
            {{"name", fmt::format("{}.{}{}.{}", p.shape, scene.materials[static_cast<std::size_t>(shape.material)].name,
                                  p.back ? ".back" : "", i)},
             {"area_m2", p.area},
             {"radiosity_W_m2_nm", std::vector<double>(row.begin(), row.end())}});
        if (errors.size() == 0) continue;
        auto const error = errors.row(static_cast<Eigen::Index>(i));
        patches.back()["standard_error_W_m2_nm"] = std::vector<double>(error.begin(), error.end());
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
    if (r.lines > 0) {
        auto const relative = solution.standard_error().matrix().norm() / solution.radiosity().matrix().norm();
        fmt::print("{}: {} lines, standard error {:.2g} of the radiosity (root mean square)\n", settings.solver,
                   r.lines, relative);
        return;
    }
    fmt::print("form factors ({}): reciprocity defect {:.2g}, closure defect {:.2g}\n", settings.form_factors,
               r.reciprocity_defect, r.closure_defect);
    if (r.links > 0) fmt::print("{} links\n", r.links);
    if (settings.substructuring > 0) fmt::print("{} elements\n", solution.field()->mesh().patch.size());
    fmt::print("{}: {} iterations, residual {:.2g}\n", settings.solver, r.iterations, r.residual);
}

int run(Options const& o) {
    auto const scene = load_scene(find_scene(o.scene));
    RenderPlan const plan = make_plan(*scene);
    if (!o.save.empty()) check_output("--save", o.save, ".ply");
    auto const start = Clock::now();
    SceneRadiosity const solution(*scene, plan.wavelengths, o.settings);
    if (!o.save.empty()) save_solution(o.save, *scene, *solution.field());
    if (o.json)
        print_json(*scene, solution, o.settings);
    else
        print_summary(solution, o.settings, seconds_since(start));
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
    parser
        ->add_option(
            "--solver", s.solver,
            "one of:" + listing(solvers()) + "\nor, by chance, without form factors:" + listing(stochastic_solvers()))
        ->capture_default_str();
    parser->add_flag("--on-demand", s.on_demand, "with shooting: form factors are made when wanted, never stored");
    parser
        ->add_option("--link-tolerance", s.link_tolerance,
                     "hierarchical: light that may go wrong over a link, of the emitted power")
        ->check(CLI::Range(1e-12, 1.0))
        ->capture_default_str();
    parser->add_option("--lines", s.lines, "stochastic solvers: lines per patch")
        ->check(CLI::Range(1, 1 << 24))
        ->capture_default_str();
    parser->add_option("--seed", s.seed, "of the stochastic solvers")->check(CLI::NonNegativeNumber);
    parser
        ->add_option("--substructuring", s.substructuring,
                     "times that receivers are split where radiosity varies by more than a tenth")
        ->check(CLI::Range(0, 6));
    parser
        ->add_option_function<double>(
            "--memory", [&s](double gigabytes) { s.memory_bytes = gigabytes * 1e9; },
            "GB that may be taken; more is refused (default: 4)")
        ->check(CLI::PositiveNumber);
    parser->add_option("--iterations", s.stop.iterations, "the most steps of the solver")
        ->check(CLI::Range(1, 1 << 30))
        ->capture_default_str();
    parser->add_option("--tolerance", s.stop.tolerance, "largest residual over the largest emission to stop at")
        ->check(CLI::Range(1e-15, 1.0))
        ->capture_default_str();
    auto* const size = parser->add_option("--size", s.size_m, "longest edge of a patch in metres");
    size->check(CLI::PositiveNumber);
    parser->add_option("--patches", s.patches, "about how many patches, instead of their size")
        ->check(CLI::Range(1, 100000000))
        ->capture_default_str()
        ->excludes(size);
    parser->add_option("--wavelengths", s.wavelengths, "how many, evenly spaced where lamps and observer overlap")
        ->check(CLI::Range(1, 1000))
        ->capture_default_str();
    parser->add_option("--save", o->save, "PLY file to write, for iride render --solution and other programs");
    parser->add_flag("--json", o->json, "print every patch with its spectrum as JSON");
    return {parser, [o] { return run(*o); }};
}

}  // namespace iride
