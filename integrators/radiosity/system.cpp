// SPDX-License-Identifier: Apache-2.0
#include "integrators/radiosity/system.h"

#include <tbb/parallel_for.h>

namespace iride::radiosity {

Spectra gathered(System const& system, Spectra const& b) {
    return system.transport ? system.transport->gather(b) : gathered_shares(system, b);
}

Spectra gathered_shares(System const& system, Spectra const& b) {
    if (system.form_factors.nonZeros() == 0 && system.transport) return system.transport->gather(b);
    return product(system.form_factors, b);
}

Spectra product(FormFactors const& factors, Spectra const& b) {
    Spectra sums(b.rows(), b.cols());
    tbb::parallel_for(tbb::blocked_range<Eigen::Index>(0, b.rows(), 64), [&](auto const& range) {
        for (Eigen::Index i = range.begin(); i < range.end(); ++i) {
            sums.row(i).setZero();
            for (FormFactors::InnerIterator F(factors, i); F; ++F) sums.row(i) += F.value() * b.row(F.col());
        }
    });
    return sums;
}

Spectra residual(System const& system, Spectra const& b) {
    return system.emission - b + system.reflectance * gathered(system, b);
}

Row ambient(System const& system, Spectra const& unshot) {
    double const area = system.area.sum();
    Row const mean_reflectance = (system.reflectance.colwise() * system.area).colwise().sum() / area;
    return unshot.colwise().sum() / (area * (1 - mean_reflectance));
}

double reciprocity_defect(System const& system) {
    if (system.form_factors.nonZeros() == 0) return 0;
    FormFactors const power = system.area.matrix().asDiagonal() * system.form_factors;
    double const largest = power.coeffs().maxCoeff();
    FormFactors const difference = power - FormFactors(power.transpose());
    return largest > 0 ? difference.coeffs().abs().maxCoeff() / largest : 0;
}

double closure_defect(System const& system) {
    Spectra const sums = gathered_shares(system, Spectra::Ones(system.patches(), 1));
    return (sums > 0).select(1 - sums, 0.0).abs().maxCoeff();
}

}  // namespace iride::radiosity
