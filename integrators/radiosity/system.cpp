// SPDX-License-Identifier: Apache-2.0
#include "integrators/radiosity/system.h"

namespace iride::radiosity {

Spectra residual(System const& system, Spectra const& b) {
    Spectra const gathered = (system.form_factors * b.matrix()).array();
    return system.emission - b + system.reflectance * gathered;
}

double reciprocity_defect(System const& system) {
    FormFactors const power = system.area.matrix().asDiagonal() * system.form_factors;
    double const largest = power.coeffs().maxCoeff();
    FormFactors const difference = power - FormFactors(power.transpose());
    return largest > 0 ? difference.coeffs().abs().maxCoeff() / largest : 0;
}

double closure_defect(System const& system) {
    Eigen::VectorXd const sums = system.form_factors * Eigen::VectorXd::Ones(system.patches());
    return (1 - sums.array()).abs().maxCoeff();
}

}  // namespace iride::radiosity
