// SPDX-License-Identifier: Apache-2.0
// Directional radiosity: surfaces that scatter by their bidirectional reflectance. The unknown is a radiance for every
// pair of patches that see each other, L_ij from i to j; light goes from patch to patch to patch,
//   L_ij = Le_ij + sum_k f_i(k, j) pi F_ik L_ki,
// f_i the mean of the BSDF over points of the three patches. With f = rho / pi this is the radiosity equation. What a
// viewer sees of i is the same sum with its own direction. n patches cost up to n^2 unknowns and n^3 values of f: for
// small scenes. [Immel 1986] [Aupperle 1993]
#pragma once

#include "integrators/radiosity/radiosity.h"

namespace iride::radiosity {

struct DirectionalSettings {
    int patches = 150;  // about how many
    int wavelengths = 8;
    int rays = 4096;  // of form factors, per patch
    Stop stop = {.iterations = 1000, .tolerance = 1e-5};
    double memory_bytes = Settings{}.memory_bytes;
};

class DirectionalRadiosity {
  public:
    // Throws InputError: lamps that are no patches, surfaces that scatter only by Dirac lobes or let light through, too
    // much memory, no solution.
    DirectionalRadiosity(Scene const& scene, WavelengthRange const& range, DirectionalSettings const& settings);

    PatchMesh const& mesh() const { return mesh_; }
    PatchTracer const& tracer() const { return *tracer_; }
    System const& system() const { return system_; }
    // What patch i sends to its k-th neighbour, a column of row i of the form factors. [W m^-2 sr^-1 nm^-1]
    Eigen::ArrayXf sent(std::size_t i, std::size_t k) const;

    // Radiance that leaves the patch along unit `to_viewer`.
    Radiance radiance(Scene const& scene, PatchHit const& hit, Direction const& to_viewer,
                      Wavelengths const& wavelengths) const;

  private:
    using Values = Eigen::Array<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;  // [..][wavelength]
    struct Neighbour {
        int patch;
        float factor;      // F to it
        std::size_t back;  // the number of the same pair the other way
    };
    void refuse_others(Scene const& scene) const;
    void find_neighbours();
    void solve(Scene const& scene, DirectionalSettings const& settings);
    std::size_t neighbours(std::size_t i) const { return first_[i + 1] - first_[i]; }
    Material const& material_of(Scene const& scene, Patch const& p) const;
    // pi F_ik f_i(k, j) for all pairs of neighbours of i: [k * neighbours + j][wavelength]
    Values scattering(Scene const& scene, std::size_t i) const;

    PatchMesh mesh_;
    std::unique_ptr<PatchTracer> tracer_;
    std::vector<double> nm_;
    System system_;
    std::vector<std::size_t> first_;    // [patch + 1] into neighbour_
    std::vector<Neighbour> neighbour_;  // pairs
    Values arriving_;                   // [pair (i, k)] what i gets from k
};

std::unique_ptr<Integrator> make_directional_radiosity(Scene const& scene, RenderPlan const& plan,
                                                       IntegratorOptions& options);

}  // namespace iride::radiosity
