// SPDX-License-Identifier: Apache-2.0
// Radiosity of a scene: patches, what they reflect and emit at evenly spaced wavelengths, form factors, solution, and
// the integrator that shows it. Radiance of a patch is b / pi in every direction.
//   What is not diffuse is taken for a diffuse surface of the same albedo under even light; light from lamps without
//   extent and from the environment enters as what it makes a patch reflect once.
#pragma once

#include "integrators/integrator.h"
#include "integrators/radiosity/form_factor_methods.h"
#include "integrators/radiosity/solvers.h"

namespace iride::radiosity {

struct Settings {
    double size_m = 0;  // longest edge of a patch; 0: so that there are about `patches`
    int patches = 2500;
    int wavelengths = 40;
    std::string form_factors = "rays", solver = "conjugate-gradients";
    int fineness = 0;  // of the form factors; 0: the method's own
    Stop stop = {};
};

struct Report {
    double reciprocity_defect, closure_defect;  // of the form factors as computed
    int iterations;
    double residual;
    std::vector<std::string> remarks;  // what was ignored or approximated
};

class SceneRadiosity {
  public:
    // Throws InputError: too many patches, unknown names, a reflectance of 1 or above.
    SceneRadiosity(Scene const& scene, WavelengthRange const& range, Settings const& settings);

    PatchMesh const& mesh() const { return mesh_; }
    System const& system() const { return system_; }
    Spectra const& radiosity() const { return radiosity_; }  // [patch][wavelength]
    std::vector<double> const& wavelengths_nm() const { return nm_; }
    Report const& report() const { return report_; }
    PatchTracer const& tracer() const { return tracer_; }

    // Radiance that leaves a place of a patch, between its vertices and between wavelengths.
    Radiance radiance(PatchHit const& hit, Wavelengths const& wavelengths) const;

  private:
    void read_spectra(Scene const& scene);
    void transfer_to_vertices();

    PatchMesh mesh_;
    PatchTracer tracer_;
    std::vector<double> nm_;
    System system_;
    Spectra radiosity_;
    Eigen::Array<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> at_vertex_;  // [vertex][wavelength]
    Report report_;
};

std::unique_ptr<Integrator> make_radiosity(Scene const& scene, RenderPlan const& plan, IntegratorOptions& options);

}  // namespace iride::radiosity
