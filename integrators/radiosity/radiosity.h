// SPDX-License-Identifier: Apache-2.0
// Radiosity of a scene: patches, what they reflect and emit at evenly spaced wavelengths, form factors or lines in
// their place, solution; and the integrator that shows it.
#pragma once

#include <memory>

#include "integrators/integrator.h"
#include "integrators/radiosity/field.h"
#include "integrators/radiosity/form_factor_methods.h"
#include "integrators/radiosity/last_gather.h"
#include "integrators/radiosity/solvers.h"
#include "integrators/radiosity/stochastic.h"

namespace iride::radiosity {

struct Settings {
    double size_m = 0;  // longest edge of a patch; 0: so that there are about `patches`
    int patches = 2500;
    int wavelengths = 40;
    std::string form_factors = "rays", solver = "conjugate-gradients";
    int fineness = 0;  // of the form factors; 0: the method's own
    Stop stop = {};
    bool on_demand = false;        // rows of form factors are made when a patch shoots, and forgotten
    double link_tolerance = 3e-7;  // hierarchical: of the emitted power
    int lines = 1000;              // stochastic solvers: per patch
    std::uint64_t seed = 0;        // of theirs
    int substructuring = 0;        // times that receivers are split where radiosity varies
    double contrast = 0.1;         // by this share of the mean over a patch
    double memory_bytes = 4e9;     // refused before it is taken
};

struct Report {
    double reciprocity_defect = 0, closure_defect = 0;  // of the form factors as computed
    int iterations = 0;
    double residual = 0;
    std::uint64_t links = 0, lines = 0;
    std::vector<std::string> remarks;  // what was ignored or approximated
};

class SceneRadiosity {
  public:
    // Throws InputError: too much memory, unknown names, no solution.
    SceneRadiosity(Scene const& scene, WavelengthRange const& range, Settings const& settings);

    // The patches that exchange light; those of field() may be finer.
    PatchMesh const& mesh() const { return mesh_; }
    System const& system() const { return system_; }
    Spectra const& radiosity() const { return radiosity_; }            // [patch][wavelength]
    Spectra const& standard_error() const { return standard_error_; }  // likewise, of stochastic solvers; else empty
    std::vector<double> const& wavelengths_nm() const { return field_->wavelengths_nm(); }
    Report const& report() const { return report_; }
    std::shared_ptr<RadiosityField const> field() const { return field_; }
    // Any [patch][wavelength] as something to be looked at.
    std::shared_ptr<RadiosityField const> field_of(Spectra const& of_patches) const {
        return field_of_patches(mesh_, wavelengths_nm(), of_patches);
    }
    // What patches send out without what their lamps emit; and of that, what did not come straight from a lamp.
    Spectra reflected() const;
    Spectra indirect() const { return system_.reflectance * gathered(system_, reflected()); }
    // That as it is looked at: as patches have it, and gathered once more where it is seen.
    std::shared_ptr<RadiosityField const> indirect_field() const { return field_of(indirect()); }
    std::shared_ptr<RadiosityField const> indirect_field(Seen const& seen_in, LampLight const& lamps,
                                                         LastGather const& settings,
                                                         std::vector<std::string>& remarks) const {
        return gathered_where_seen({mesh_, *tracer_, wavelengths_nm(), system_.reflectance, reflected(), indirect()},
                                   lamps, seen_in, settings, remarks);
    }
    PatchTracer const& tracer() const { return field_->tracer(); }
    Radiance radiance(PatchHit const& hit, Wavelengths const& wavelengths) const {
        return field_->radiance(hit, wavelengths);
    }

  private:
    void solve_stored(Scene const& scene, std::vector<double> const& nm, FormFactorMethod const& method,
                      SolverEntry const& solver, Settings const& settings, bool mirrors);
    void take(Solution solution);
    void say_what_leaks(Scene const& scene);
    bool sees_out(std::size_t patch) const;
    void solve_on_demand(FormFactorMethod const& method, Settings const& settings);
    void solve_by_lines(Settings const& settings, StochasticEntry const& entry);
    void substructure(Scene const& scene, std::vector<double> const& nm, FormFactorMethod const& method,
                      Settings const& settings);

    PatchMesh mesh_;
    std::unique_ptr<PatchTracer> tracer_;
    System system_;
    Spectra radiosity_, standard_error_;
    std::shared_ptr<RadiosityField const> field_;
    Report report_;
};

// Looks at a solution. `remarks`: what the user is told of it.
std::unique_ptr<Integrator> show(std::shared_ptr<RadiosityField const> field, std::vector<std::string> remarks = {});

std::unique_ptr<Integrator> make_radiosity(Scene const& scene, RenderPlan const& plan, IntegratorOptions& options);

}  // namespace iride::radiosity
