// SPDX-License-Identifier: Apache-2.0
// Solvers of the radiosity equation (system.h), all wavelengths at once. With beta_i = A_i b_i and the residual sigma_i
// = A_i (e - M b)_i, unshot power:
//   jacobi               b_i <- (e_i + rho_i sum_{j != i} F_ij b_j) / (1 - rho_i F_ii), all at once
//   gauss-seidel         the same, one after another, each from the latest of the others
//   over-relaxation      gauss-seidel's step times omega
//   southwell            the patch of the largest |sigma| alone: beta_i += sigma_i / K_ii, K_ij = delta_ij - rho_i F_ji
//   shooting             southwell, whose answer is shot plus unshot plus an ambient share:
//                        b + sigma / A + rho Phi, Phi = sum sigma / (A_total (1 - mean rho))
//   conjugate-gradients  on I - S, S = rho^1/2 A^1/2 F A^-1/2 rho^1/2, symmetric by reciprocity;
//                        b = e + (rho / A)^1/2 z, whose residual is (rho / A)^1/2 times that of z
//   direct               LU factors of M, a wavelength at a time
// The book's ambient term lacks the unshot part sigma / A: here it is that of [Cohen 1988]. Southwell and shooting
// choose by power summed over the wavelengths. [Saad 2003]
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>

#include "integrators/radiosity/system.h"

namespace iride::radiosity {

class Solver {
  public:
    virtual ~Solver() = default;
    // One sweep over the patches (southwell, shooting: one patch; direct: everything).
    virtual void step() = 0;
    // The answer so far.
    virtual Spectra radiosity() const = 0;
    // e - M b of it, where that is known without another product with F.
    virtual std::optional<Spectra> residual() const { return std::nullopt; }
};

struct SolverEntry {
    char const* name;
    char const* summary;
    bool needs_matrix;                               // wants rows of F: no Transport will do
    std::unique_ptr<Solver> (*make)(System const&);  // keeps a reference
};
std::span<SolverEntry const> solvers();

// omega in (0, 2).
std::unique_ptr<Solver> over_relaxation(System const& system, double omega);

struct Stop {
    int iterations = 10000;
    double tolerance = 1e-6;  // of the largest residual over the largest emission, wavelength by wavelength
};
struct Solution {
    Spectra radiosity;
    int iterations;
    double residual;  // as in Stop
};
Solution solve(System const& system, SolverEntry const& entry, Stop const& stop);

// Spectral radius of the iteration matrices of jacobi and gauss-seidel for one wavelength: the factor by which an error
// shrinks a sweep in the end. By the eigenvalues of dense matrices, so for small systems.
struct Rates {
    double jacobi, gauss_seidel;
};
Rates spectral_radii(System const& system, Eigen::Index wavelength);

}  // namespace iride::radiosity
