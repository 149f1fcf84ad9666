// SPDX-License-Identifier: Apache-2.0
#include "colour/rec709_basis.h"

#include <Eigen/Dense>
#include <algorithm>
#include <set>

#include "colour/observer.h"
#include "colour/rgb_to_spectrum.h"

namespace iride {

namespace {

constexpr double step_nm = 5;
constexpr int knots = 95;  // 360 .. 830 nm

// XYZ of each knot's hat function under D65 of luminance 1: the colour of sum_i b_i hat_i is a product with this.
Eigen::Matrix3Xd hat_colours() {
    Eigen::Matrix3Xd result(3, knots);
    Observer const& eye = cie1931_2deg();
    for (int i = 0; i < knots; ++i) {
        double const centre = visible_range.min_nm + step_nm * i;
        SpectralFunction const hat(TabulatedShape{{centre - step_nm, centre, centre + step_nm}, {0, 1, 0}},
                                   Outside::zero);
        // hat times D65, as a table at 1 nm: both are linear between whole multiples of 5 nm.
        VectorDouble sum(0, 0, 0);
        WavelengthRange const support{std::max(visible_range.min_nm, centre - step_nm),
                                      std::min(visible_range.max_nm, centre + step_nm)};
        constexpr int cells = 10;
        for (int c = 0; c < cells; ++c) {
            double const width = support.width() / cells, middle = support.min_nm + (c + 0.5) * width;
            for (double side : {-1.0, 1.0}) {  // two-point Gauss rule
                double const nm = middle + side * width / 2 / std::sqrt(3.0);
                sum += width / 2 * hat.at(nm) * unit_d65().at(nm) * to_vector(eye.at(nm));
            }
        }
        result.col(i) = sum / eye.ybar_integral;
    }
    return result;
}

// Unknowns: b[k * knots + i], the value of basis function k at knot i. Minimise the squared second differences subject
// to the colour of each primary and to sum_k b_k = 1; values that would leave [0, 1] are held at the bound (the active
// set), found one round after the other.
Eigen::VectorXd solve_basis() {
    constexpr int unknowns = 3 * knots;
    Eigen::Matrix3Xd const colours = hat_colours();
    MatrixDouble const primaries = rgb::rec709.to_xyz_matrix();
    MatrixDouble const white_scale =
        to_vector(cie1931_2deg().integrate(unit_d65())).cwiseQuotient(primaries * VectorDouble::Ones()).asDiagonal();

    Eigen::MatrixXd smooth = Eigen::MatrixXd::Zero(unknowns, unknowns);
    for (int k = 0; k < 3; ++k)
        for (int i = 1; i + 1 < knots; ++i) {
            int const at = k * knots + i;
            Eigen::Vector3d const d(1, -2, 1);
            smooth.block<3, 3>(at - 1, at - 1) += d * d.transpose();
        }
    // Rows: colours of red and green (blue follows from the sum), then the sums.
    std::vector<Eigen::VectorXd> rows;
    std::vector<double> values;
    for (int k = 0; k < 2; ++k)
        for (int c = 0; c < 3; ++c) {
            Eigen::VectorXd row = Eigen::VectorXd::Zero(unknowns);
            row.segment(k * knots, knots) = colours.row(c);
            rows.push_back(row);
            values.push_back((white_scale * primaries)(c, k));
        }
    for (int i = 0; i < knots; ++i) {
        Eigen::VectorXd row = Eigen::VectorXd::Zero(unknowns);
        for (int k = 0; k < 3; ++k) row[k * knots + i] = 1;
        rows.push_back(row);
        values.push_back(1);
    }

    std::set<int> at_zero;
    Eigen::VectorXd b;
    constexpr int most_rounds = 100;
    for (int round = 0; round < most_rounds; ++round) {
        auto const constraints = static_cast<Eigen::Index>(rows.size() + at_zero.size());
        Eigen::MatrixXd system = Eigen::MatrixXd::Zero(unknowns + constraints, unknowns + constraints);
        Eigen::VectorXd right = Eigen::VectorXd::Zero(unknowns + constraints);
        system.topLeftCorner(unknowns, unknowns) = 2 * smooth;
        Eigen::Index at = unknowns;
        auto const constrain = [&](Eigen::VectorXd const& row, double value) {
            system.block(at, 0, 1, unknowns) = row.transpose();
            system.block(0, at, unknowns, 1) = row;
            right[at++] = value;
        };
        for (std::size_t i = 0; i < rows.size(); ++i) constrain(rows[i], values[i]);
        for (int i : at_zero) constrain(Eigen::VectorXd::Unit(unknowns, i), 0);
        // Where all but one are held at zero, the sum makes a row redundant: a rank-revealing factorisation.
        b = system.completeOrthogonalDecomposition().solve(right).head(unknowns);
        // Values below 0 go to the bound; since they sum to 1 and none is negative, none exceeds 1.
        std::size_t const before = at_zero.size();
        for (int i = 0; i < unknowns; ++i)
            if (b[i] < -1e-12) at_zero.insert(i);
        if (at_zero.size() == before) break;
    }
    for (double& value : b) value = std::clamp(value, 0.0, 1.0);  // what is left of -1e-12
    return b;
}

}  // namespace

std::array<SpectralFunction, 3> const& rec709_basis() {
    static std::array<SpectralFunction, 3> const basis = [] {
        Eigen::VectorXd const b = solve_basis();
        auto const part = [&](int k) {
            TabulatedShape table;
            for (int i = 0; i < knots; ++i) {
                table.nm.push_back(visible_range.min_nm + step_nm * i);
                table.value.push_back(b[k * knots + i]);
            }
            return SpectralFunction(std::move(table), Outside::hold, "Rec.709 basis");
        };
        return std::array{part(0), part(1), part(2)};
    }();
    return basis;
}

}  // namespace iride
