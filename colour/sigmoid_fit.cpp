// SPDX-License-Identifier: Apache-2.0
#include "colour/sigmoid_fit.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "colour/lab.h"

namespace iride {

namespace {

constexpr double step_nm = 2.5;

VectorDouble lab_of(VectorDouble const& ratio) {
    Lab const lab = to_lab(to_xyz(ratio), {1, 1, 1});
    return {lab.L, lab.a, lab.b};
}

// d(L*, a*, b*) / d(X/Xn, Y/Yn, Z/Zn), of the formulas in colour/lab.h.
MatrixDouble lab_derivative(VectorDouble const& ratio) {
    constexpr double delta = 6.0 / 29;
    VectorDouble const f = ratio.unaryExpr(
        [](double t) { return t > delta * delta * delta ? 1 / (3 * square(std::cbrt(t))) : 1 / (3 * delta * delta); });
    MatrixDouble d;
    d << 0, 116 * f[1], 0, 500 * f[0], -500 * f[1], 0, 0, 200 * f[1], -200 * f[2];
    return d;
}

// x of the constant reflectance `value`: the inverse of 1/2 + x / (2 sqrt(1 + x^2)).
double grey_argument(double value) { return (value - 0.5) / std::sqrt(value * (1 - value)); }

}  // namespace

SigmoidFitter::SigmoidFitter(SpectralFunction const& light, Observer const& observer) {
    auto const nm = [](int knot) { return visible_range.min_nm + step_nm * knot; };
    for (int i = 0; i < knots; ++i)
        fine_.t[static_cast<std::size_t>(i)] =
            (2 * nm(i) - visible_range.min_nm - visible_range.max_nm) / visible_range.width();
    VectorDouble total = VectorDouble::Zero();
    double const offset = 0.5 / std::sqrt(3.0);  // two-point Gauss rule in every nanometre
    for (double start = visible_range.min_nm; start < visible_range.max_nm; ++start)
        for (double const at : {start + 0.5 - offset, start + 0.5 + offset}) {
            VectorDouble const density = light.at(at) * to_vector(observer.at(at));
            total += density;
            int const first = std::clamp(static_cast<int>((at - visible_range.min_nm) / step_nm) - 1, 0, knots - 4);
            for (int i = first; i < first + 4; ++i) {
                double cardinal = 1;
                for (int j = first; j < first + 4; ++j)
                    if (j != i) cardinal *= (at - nm(j)) / (nm(i) - nm(j));
                for (std::size_t c = 0; c < 3; ++c)
                    fine_.weight[c][static_cast<std::size_t>(i)] += cardinal * density[static_cast<Eigen::Index>(c)];
            }
        }
    for (std::size_t c = 0; c < 3; ++c)
        for (double& weight : fine_.weight[c]) weight /= total[static_cast<Eigen::Index>(c)];
    std::ranges::transform(fine_.t, quick_.t.begin(), [](double t) { return static_cast<float>(t); });
    for (std::size_t c = 0; c < 3; ++c)
        std::ranges::transform(fine_.weight[c], quick_.weight[c].begin(),
                               [](double w) { return static_cast<float>(w); });
}

struct SigmoidFitter::Evaluation {
    VectorDouble ratio;       // XYZ over the light's
    MatrixDouble derivative;  // by the three coefficients
    double steepest;          // per nm
};

template <class Real>
SigmoidFitter::Evaluation SigmoidFitter::Quadrature<Real>::evaluate(VectorDouble const& coefficients) const {
    // Sums side by side, so that the compiler may use whole registers: S and S' times t^0, t^1, t^2.
    constexpr std::size_t lanes = 64 / sizeof(Real);
    constexpr Real half{0.5};
    Real const p0 = static_cast<Real>(coefficients[0]), p1 = static_cast<Real>(coefficients[1]),
               p2 = static_cast<Real>(coefficients[2]);
    Real sum[3][4][lanes] = {}, steepest[lanes] = {};
    for (std::size_t i = 0; i < padded; i += lanes)
        for (std::size_t l = 0; l < lanes; ++l) {
            Real const at = t[i + l], x = (p0 * at + p1) * at + p2, inverse = 1 / std::sqrt(1 + x * x);
            Real const value = half + half * x * inverse, slope = half * inverse * inverse * inverse;
            steepest[l] = std::max(steepest[l], slope * std::abs(2 * p0 * at + p1));
            for (std::size_t c = 0; c < 3; ++c) {
                Real const w = weight[c][i + l], wd = w * slope;
                sum[c][0][l] += w * value;
                sum[c][1][l] += wd * at * at;
                sum[c][2][l] += wd * at;
                sum[c][3][l] += wd;
            }
        }
    Evaluation result{VectorDouble::Zero(), MatrixDouble::Zero(),
                      static_cast<double>(*std::max_element(steepest, steepest + lanes)) * 2 / visible_range.width()};
    for (Eigen::Index c = 0; c < 3; ++c)
        for (std::size_t l = 0; l < lanes; ++l) {
            auto const& s = sum[c];
            result.ratio[c] += static_cast<double>(s[0][l]);
            result.derivative.row(c) += Eigen::Matrix<Real, 1, 3>(s[1][l], s[2][l], s[3][l]).template cast<double>();
        }
    return result;
}

SigmoidFitter::Evaluation SigmoidFitter::evaluate(VectorDouble const& coefficients, FitEffort const& effort) const {
    constexpr double of_floats = 1e-3;  // CIE 1976 difference that floats tell from none
    return effort.difference >= of_floats ? quick_.evaluate(coefficients) : fine_.evaluate(coefficients);
}

SigmoidFit SigmoidFitter::fit(VectorDouble const& wanted) const {
    constexpr double rounding = 1e-12;  // relative: a grey that came through matrices is a grey
    double const Y = wanted[1];
    if ((wanted.array() - Y).abs().maxCoeff() <= rounding * std::max(Y, 0.0) && Y > 0 && Y < 1)
        return {{0, 0, grey_argument(Y)}, VectorDouble::Constant(Y), 0};
    constexpr double least = 1e-3;  // reflectance to start from: at 0 and 1 the sigmoid has no slope
    SigmoidFit const from_grey = fit(wanted, {0, 0, grey_argument(std::clamp(Y, least, 1 - least))});
    constexpr double dark = 0.1;
    if (from_grey.difference <= FitEffort{}.difference || wanted.maxCoeff() > dark || !(wanted.minCoeff() > 0))
        return from_grey;
    // A dark saturated colour lies in the flat tail of the sigmoid: come from a brighter one.
    SigmoidFit const from_bright = fit(wanted, fit(2 * wanted).sigmoid);
    return from_bright.difference < from_grey.difference ? from_bright : from_grey;
}

SigmoidFit SigmoidFitter::fit(VectorDouble const& wanted, SigmoidShape const& start, FitEffort const& effort) const {
    constexpr double most_damping = 1e12;  // no step downhill is left
    VectorDouble const target = lab_of(wanted);
    VectorDouble p(start.a, start.b, start.c);
    Evaluation here = evaluate(p, effort);
    VectorDouble residual = lab_of(here.ratio) - target;
    double damping = 1e-3;
    for (int round = 0; round < effort.rounds && residual.norm() > effort.difference && damping < most_damping;
         ++round) {
        MatrixDouble const jacobian = lab_derivative(here.ratio) * here.derivative;
        MatrixDouble normal = jacobian.transpose() * jacobian;
        normal.diagonal() *= 1 + damping;
        VectorDouble const next = p - normal.inverse() * (jacobian.transpose() * residual);
        Evaluation const there = evaluate(next, effort);
        VectorDouble const rest = lab_of(there.ratio) - target;
        if (rest.norm() < residual.norm() && there.steepest < steepest_reflectance) {
            p = next, here = there, residual = rest;
            damping = std::max(damping / 10, 1e-12);
        } else {
            damping *= 4;
        }
    }
    return {{p[0], p[1], p[2]}, here.ratio, residual.norm()};
}

SigmoidFit SigmoidFitter::nearest(VectorDouble const& wanted) const {
    SigmoidFit best = fit(wanted);
    for (double const step : {0.6, 0.8, 1.25})
        for (int i = 0; i < 27; ++i) {
            VectorDouble const factors(std::pow(step, i % 3 - 1), std::pow(step, i / 3 % 3 - 1),
                                       std::pow(step, i / 9 - 1));
            VectorDouble const around = wanted.cwiseProduct(factors).cwiseMax(1e-3).cwiseMin(1 - 1e-3);
            SigmoidFit const other = fit(wanted, fit(around).sigmoid);
            if (other.difference < best.difference) best = other;
        }
    return best;
}

}  // namespace iride
