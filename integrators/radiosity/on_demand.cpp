// SPDX-License-Identifier: Apache-2.0
#include "integrators/radiosity/on_demand.h"

namespace iride::radiosity {

Solution shoot_on_demand(System const& system, PatchMesh const& mesh, RowOfFactors const& row, Stop const& stop) {
    Spectra shot = Spectra::Zero(system.patches(), system.wavelengths()),
            unshot = system.emission.colwise() * system.area;
    Eigen::ArrayXd urgency = unshot.rowwise().sum();
    double const emitted = urgency.sum();
    RowSums sums(static_cast<std::size_t>(system.patches()));
    int steps = 0;
    while (steps < stop.iterations && urgency.sum() > stop.tolerance * emitted) {
        Eigen::Index i;
        urgency.maxCoeff(&i);
        Row const power = unshot.row(i);
        shot.row(i) += power;
        unshot.row(i).setZero();
        urgency[i] = 0;
        row(mesh, static_cast<std::size_t>(i), sums);
        sums.take([&](int j, double F) {
            unshot.row(j) += system.reflectance.row(j) * (F * power);
            urgency[j] = unshot.row(j).sum();
        });
        ++steps;
    }
    return {(shot + unshot).colwise() / system.area + system.reflectance.rowwise() * ambient(system, unshot), steps,
            emitted > 0 ? urgency.sum() / emitted : 0};
}

}  // namespace iride::radiosity
