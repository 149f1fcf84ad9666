// SPDX-License-Identifier: Apache-2.0
#include "integrators/radiosity/radiosity.h"

#include <fmt/format.h>

#include "integrators/radiosity/exposure.h"
#include "integrators/radiosity/global_lines.h"
#include "integrators/radiosity/hierarchy.h"
#include "integrators/radiosity/memory.h"
#include "integrators/radiosity/mirrors.h"
#include "integrators/radiosity/on_demand.h"
#include "integrators/radiosity/patch_spectra.h"
#include "integrators/radiosity/solvability.h"
#include "integrators/radiosity/substructure.h"

namespace iride::radiosity {

namespace {

double patch_size(Scene const& scene, Settings const& s) {
    return s.size_m > 0 ? s.size_m : std::sqrt(area_of_fronts(scene) / s.patches);
}

template <class Entry>
Entry const* find(std::span<Entry const> table, std::string const& name) {
    for (Entry const& e : table)
        if (name == e.name) return &e;
    return nullptr;
}

template <class... Tables>
[[noreturn]] void unknown(char const* option, std::string const& name, Tables... tables) {
    std::vector<std::string> names;
    auto const add = [&](auto const& table) {
        for (auto const& e : table) names.emplace_back(e.name);
    };
    (add(tables), ...);
    throw InputError({}, option, fmt::format("unknown name '{}'{}", name, suggestion(name, names)));
}

std::vector<double> evenly_spaced(WavelengthRange const& range, int count) {
    if (count < 2) return {(range.min_nm + range.max_nm) / 2};
    std::vector<double> nm;
    for (int i = 0; i < count; ++i) nm.push_back(range.min_nm + range.width() * i / (count - 1));
    return nm;
}

int fineness_of(Settings const& s, FormFactorMethod const& m) { return s.fineness > 0 ? s.fineness : m.fineness; }

// `option`: what wants rows.
RowOfFactors rows_of(FormFactorMethod const& m, PatchTracer const& tracer, Settings const& s, char const* option) {
    if (!m.rows)
        throw InputError(
            {}, option,
            fmt::format("form factors by {} come all at once; allowed: rays, hemicube, hemisphere", m.name));
    return m.rows(tracer, fineness_of(s, m));
}

void refuse_trapped_light(Scene const& scene, PatchMesh const& mesh, System const& system,
                          std::vector<double> const& nm) {
    if (auto const t = light_that_is_never_lost(system))
        throw InputError({}, "radiosity",
                         fmt::format("{} reflects {:g} at {:g} nm, and what it sends out is absorbed nowhere: such a "
                                     "closed scene has no radiosity",
                                     describe(scene, mesh, t->patch),
                                     system.reflectance(static_cast<Eigen::Index>(t->patch), t->wavelength),
                                     nm[static_cast<std::size_t>(t->wavelength)]));
}

// The same where no form factors say whether the scene is closed: something must absorb.
void refuse_white(Scene const& scene, PatchMesh const& mesh, System const& system) {
    constexpr double white = 0.9999;
    Eigen::Index i;
    if (system.reflectance.rowwise().minCoeff().minCoeff(&i) > white)
        throw InputError({}, "radiosity",
                         fmt::format("{} and all others reflect everything: nothing absorbs the light",
                                     describe(scene, mesh, static_cast<std::size_t>(i))));
}

}  // namespace

SceneRadiosity::SceneRadiosity(Scene const& scene, WavelengthRange const& range, Settings const& settings) {
    FormFactorMethod const* const method = find(form_factor_methods(), settings.form_factors);
    SolverEntry const* const solver = find(solvers(), settings.solver);
    StochasticEntry const* const stochastic = find(stochastic_solvers(), settings.solver);
    if (!method) unknown("--form-factors", settings.form_factors, form_factor_methods());
    if (!solver && !stochastic) unknown("--solver", settings.solver, solvers(), stochastic_solvers());
    bool const stored = solver && !settings.on_demand;
    double const size = patch_size(scene, settings);
    // Rays are followed over mirrors where what they find is kept as it is.
    bool const mirrors = stored && !solver->needs_matrix && settings.form_factors == "rays" &&
                         settings.substructuring == 0 && std::ranges::any_of(scene.materials, is_mirror);
    auto const check_memory = [&](double patches) {
        refuse_if_too_large(patches, settings.wavelengths, stored ? method : nullptr, fineness_of(settings, *method),
                            settings.memory_bytes, mirrors);
    };
    check_memory(expected_patches(scene, size));
    mesh_ = make_patches(scene, size);
    check_memory(static_cast<double>(mesh_.patch.size()));
    tracer_ = std::make_unique<PatchTracer>(mesh_);
    std::vector<double> const nm = evenly_spaced(range, settings.wavelengths);
    system_ = patch_spectra(scene, mesh_, *tracer_, nm, mirrors);
    report_.remarks = approximations(scene, mesh_, mirrors);
    if (stored)
        solve_stored(scene, nm, *method, *solver, settings, mirrors);
    else
        refuse_white(scene, mesh_, system_);
    if (stochastic) solve_by_lines(settings, *stochastic);
    if (solver && settings.on_demand) solve_on_demand(*method, settings);
    if (settings.substructuring > 0)
        substructure(scene, nm, *method, settings);
    else
        field_ = field_of_patches(mesh_, nm, radiosity_);
}

Spectra SceneRadiosity::reflected() const {
    Spectra b = radiosity_;
    for (Eigen::Index i = 0; i < b.rows(); ++i)
        if (mesh_.shape[static_cast<std::size_t>(mesh_.patch[static_cast<std::size_t>(i)].shape)]->light >= 0)
            b.row(i) -= system_.emission.row(i);
    return b;
}

void SceneRadiosity::solve_stored(Scene const& scene, std::vector<double> const& nm, FormFactorMethod const& method,
                                  SolverEntry const& solver, Settings const& settings, bool mirrors) {
    int const fineness = fineness_of(settings, method);
    auto const describe_factors = [&] {
        report_.reciprocity_defect = reciprocity_defect(system_);
        report_.closure_defect = closure_defect(system_);
    };
    if (mirrors) {
        extend_form_factors(system_, mesh_, *tracer_, Mirrors(scene, mesh_, nm), fineness, describe_factors);
    } else if (method.compute) {
        system_.form_factors = method.compute(mesh_, *tracer_, fineness);
        describe_factors();
        make_reciprocal(system_);
    } else {
        if (solver.needs_matrix)
            throw InputError({}, "--solver",
                             fmt::format("'{}' wants form factors as a matrix, those by {} are none; allowed: "
                                         "conjugate-gradients, jacobi",
                                         solver.name, method.name));
        auto const hierarchy = std::make_shared<Hierarchy>(
            mesh_, *tracer_, system_,
            HierarchyLimits{settings.link_tolerance, fineness,
                            settings.memory_bytes - memory_needed(static_cast<double>(mesh_.patch.size()),
                                                                  settings.wavelengths, nullptr, 0)});
        report_.links = hierarchy->links();
        report_.closure_defect = hierarchy->closure_defect();
        system_.transport = hierarchy;
    }
    refuse_trapped_light(scene, mesh_, system_, nm);
    take(solve(system_, solver, settings.stop));
    say_what_leaks(scene);
}

void SceneRadiosity::take(Solution solution) {
    radiosity_ = std::move(solution.radiosity);
    report_.iterations = solution.iterations;
    report_.residual = solution.residual;
}

bool SceneRadiosity::sees_out(std::size_t patch) const {
    constexpr std::uint32_t rays = 64;
    Patch const& p = mesh_.patch[patch];
    for (std::uint32_t k = 0; k < rays; ++k) {
        Sampler sampler(SamplerKind::sobol, 6, static_cast<std::uint32_t>(patch), k);
        auto const [from, way] = line_from(mesh_, p, sampler);
        if (!tracer_->closest(from, p.normal, way)) return true;
    }
    return false;
}

// Rows that sum to less than 1 by more than their own error, when no environment is there to be seen.
void SceneRadiosity::say_what_leaks(Scene const& scene) {
    if (!scene.lights.environments().empty()) return;
    constexpr double noticeable = 0.01, dark = 1e-6;  // dark: of the brightest patch
    Eigen::ArrayXd const brightness = radiosity_.rowwise().maxCoeff();
    Eigen::ArrayXd const sums = gathered_shares(system_, Spectra::Ones(system_.patches(), 1)).col(0);
    // Not those without light to lose, nor those that lie against a body.
    Eigen::Index worst = -1;
    double lost = 0, area = 0;
    for (Eigen::Index i = 0; i < sums.size(); ++i) {
        if (sums[i] > 1 - noticeable || brightness[i] <= dark * brightness.maxCoeff()) continue;
        if (!sees_out(static_cast<std::size_t>(i))) continue;
        area += system_.area[i] / system_.area.sum();
        if (1 - sums[i] > lost) lost = 1 - sums[i], worst = i;
    }
    if (worst < 0) return;
    report_.remarks.push_back(fmt::format(
        "radiosity: the scene leaks: closure defect {:.2g} at {}; {:.2g} of the area sees out, and what leaves is lost",
        lost, describe(scene, mesh_, static_cast<std::size_t>(worst)), area));
}

void SceneRadiosity::solve_on_demand(FormFactorMethod const& method, Settings const& settings) {
    if (settings.solver != "shooting")
        throw InputError({}, "--on-demand",
                         fmt::format("found solver '{}', allowed: shooting, the one that wants a row of form factors "
                                     "at a time",
                                     settings.solver));
    take(shoot_on_demand(system_, mesh_, rows_of(method, *tracer_, settings, "--on-demand"), settings.stop));
}

void SceneRadiosity::solve_by_lines(Settings const& settings, StochasticEntry const& entry) {
    GlobalLines const lines(mesh_, *tracer_);
    LineSource const source{
        [&](int patch, Sampler& sampler) {
            Patch const& p = mesh_.patch[static_cast<std::size_t>(patch)];
            if (p.open == 0) return -1;
            auto const [from, way] = line_from(mesh_, p, sampler);
            auto const hit = tracer_->closest(from, p.normal, way);
            return hit ? hit->patch : -1;
        },
        [&](std::uint32_t series, std::uint32_t number, std::function<void(int, int)> const& faces) {
            lines.follow(
                series, number, [](int) {}, faces);
        },
        lines.meetings(1)};
    StochasticSolution solution =
        entry.solve(system_, source, static_cast<std::uint64_t>(settings.lines) * mesh_.patch.size(), settings.seed);
    radiosity_ = std::move(solution.radiosity);
    standard_error_ = std::move(solution.standard_error);
    report_.lines = solution.lines;
    report_.iterations = solution.iterations;
}

void SceneRadiosity::substructure(Scene const& scene, std::vector<double> const& nm, FormFactorMethod const& method,
                                  Settings const& settings) {
    RowOfFactors const row = rows_of(method, *tracer_, settings, "--substructuring");
    Elements elements = whole_patches(mesh_);
    Spectra b = radiosity_;
    for (int level = 0; level < settings.substructuring; ++level) {
        elements = split(elements, varying(elements, b, settings.contrast));
        find_open_parts(elements.mesh);
        refuse_if_too_large(static_cast<double>(elements.mesh.patch.size()), settings.wavelengths, &method,
                            fineness_of(settings, method), settings.memory_bytes);
        FormFactors const of_elements = assemble(elements.mesh, mesh_.patch.size(), row);
        system_.form_factors = factors_of_patches(system_, elements, of_elements);
        system_.transport.reset();
        refuse_trapped_light(scene, mesh_, system_, nm);
        // Not conjugate gradients: the mean of the elements' rows is reciprocal only on average.
        take(solve(system_, *find(solvers(), "gauss-seidel"), settings.stop));
        b = radiosity_of_elements(system_, elements, of_elements, radiosity_);
    }
    field_ = field_of_patches(std::move(elements.mesh), nm, b);
}

}  // namespace iride::radiosity
