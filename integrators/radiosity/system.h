// SPDX-License-Identifier: Apache-2.0
// The radiosity equation of n patches for w wavelengths: every wavelength shares the form factors.
//   b_i = e_i + rho_i sum_j F_ij b_j        M b = e,   M = I - diag(rho) F
//   F_ij   share of the power leaving patch i that arrives at patch j: A_i F_ij = A_j F_ji, sum_j F_ij <= 1
//   b, e   radiosity and emitted exitance [W m^-2 nm^-1]; a diffuse patch of radiosity b has radiance b / pi
// [Goral 1984] [Cohen 1993]
#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <memory>

namespace iride::radiosity {

using FormFactors = Eigen::SparseMatrix<double, Eigen::RowMajor>;
using Spectra = Eigen::Array<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;  // [patch][wavelength]
using Row = Eigen::Array<double, 1, Eigen::Dynamic>;                                    // [wavelength]

// The product with F where F is not a matrix of its own, or depends on the wavelength.
class Transport {
  public:
    virtual ~Transport() = default;
    virtual Spectra gather(Spectra const& b) const = 0;  // [patch][wavelength]
};

struct System {
    Eigen::ArrayXd area;       // [patch], m^2
    FormFactors form_factors;  // [patch][patch]; empty where a transport is all there is
    Spectra reflectance;       // 0 <= rho < 1
    Spectra emission;          // W m^-2 nm^-1
    std::shared_ptr<Transport const> transport = {};

    Eigen::Index patches() const { return area.size(); }
    Eigen::Index wavelengths() const { return emission.cols(); }
};

// F b, row after row in parallel.
Spectra product(FormFactors const& factors, Spectra const& b);
// The same of the system's transport, if it has one.
Spectra gathered(System const& system, Spectra const& b);

// The same for any number of columns, as if mirrors lost nothing: shares of the light that does not leave the scene.
Spectra gathered_shares(System const& system, Spectra const& b);

// e - M b: what a radiosity still lacks. [W m^-2 nm^-1]
Spectra residual(System const& system, Spectra const& b);

// The ambient term of progressive refinement: what unshot power makes if it spreads evenly over all surfaces,
// sum / (A (1 - mean rho)). [W m^-2 nm^-1]
Row ambient(System const& system, Spectra const& unshot);

// The largest |A_i F_ij - A_j F_ji| over the largest A_i F_ij, and the largest |1 - sum_j F_ij| of patches that see
// any.
double reciprocity_defect(System const& system);
double closure_defect(System const& system);

}  // namespace iride::radiosity
