// SPDX-License-Identifier: Apache-2.0
#include "colour/planckian_locus.h"

#include <cmath>

namespace iride {

namespace {

constexpr double mired_K = 1e6;  // reciprocal megakelvin times kelvin
constexpr double node_step = 5;  // mired: nowhere does the locus turn so much that two minima share an interval

}  // namespace

PlanckianLocus::PlanckianLocus(Observer const& observer) {
    WavelengthRange const domain = observer.ybar.defined_on();
    for (double nm = std::ceil(domain.min_nm); nm <= domain.max_nm; ++nm) {
        exponent_.push_back(second_radiation_constant / (nm * 1e-9 * mired_K));
        constexpr double reference_nm = 560;  // any: it scales the sums to a handy size
        weight_.push_back(std::pow(reference_nm / nm, 5) * to_vector(observer.at(nm)));
    }
    // One interval beyond both ends, so that a nearest point outside the range is known to be outside.
    for (double m = mired_K / hottest_K - node_step; m <= mired_K / coldest_K + node_step; m += node_step) {
        node_mired_.push_back(m);
        node_.push_back(at_mired(m).uv);
    }
}

PlanckianLocus::Point PlanckianLocus::at_mired(double mired) const {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero(), slope = Eigen::Vector3d::Zero();
    for (std::size_t i = 0; i < exponent_.size(); ++i) {
        double const planck = 1 / (std::exp(exponent_[i] * mired) - 1);  // the exponent is above .08: nothing cancels
        sum += planck * weight_[i];
        slope -= planck * (1 + planck) * exponent_[i] * weight_[i];
    }
    Eigen::Vector3d const denominator(1, 15, 3);  // u = 4X / d, v = 6Y / d
    double const d = denominator.dot(sum), d_slope = denominator.dot(slope);
    return {{4 * sum[0] / d, 6 * sum[1] / d},
            {4 * (slope[0] * d - sum[0] * d_slope) / (d * d), 6 * (slope[1] * d - sum[1] * d_slope) / (d * d)}};
}

Uv1960 PlanckianLocus::at(double temperature_K) const { return at_mired(mired_K / temperature_K).uv; }

std::optional<CorrelatedTemperature> PlanckianLocus::nearest(Uv1960 const& c) const {
    if (!std::isfinite(c.u) || !std::isfinite(c.v)) return std::nullopt;
    std::size_t best = 0;
    auto const distance = [&](Uv1960 const& p) { return std::hypot(p.u - c.u, p.v - c.v); };
    for (std::size_t i = 1; i < node_.size(); ++i)
        if (distance(node_[i]) < distance(node_[best])) best = i;
    if (best == 0 || best + 1 == node_.size()) return std::nullopt;
    // Root of the derivative of half the squared distance, which is negative before the nearest point, by regula falsi.
    auto const derivative = [&](double mired) {
        Point const p = at_mired(mired);
        return (p.uv.u - c.u) * p.slope.u + (p.uv.v - c.v) * p.slope.v;
    };
    double low = node_mired_[best - 1], high = node_mired_[best + 1];
    double at_low = derivative(low), at_high = derivative(high);
    if (!(at_low < 0 && at_high > 0)) return std::nullopt;
    constexpr double enough = 1e-9;  // mired: 1e-5 K at 100000 K
    constexpr int many = 60;         // steps, of which about eight are needed
    double mired = node_mired_[best], last = low;
    for (int i = 0; i < many && std::abs(mired - last) > enough; ++i) {
        last = mired;
        mired = low + (high - low) * at_low / (at_low - at_high);
        double const value = derivative(mired);
        // Illinois: the end that stays counts half, so that the next step passes the root.
        if (value < 0) {
            low = mired;
            at_low = value;
            at_high /= 2;
        } else {
            high = mired;
            at_high = value;
            at_low /= 2;
        }
    }
    constexpr double rounding = 1e-9;  // of T: a blackbody at the very end of the range is inside
    double const T = mired_K / mired;
    if (T < coldest_K * (1 - rounding) || T > hottest_K * (1 + rounding)) return std::nullopt;
    Uv1960 const p = at_mired(mired).uv;
    return CorrelatedTemperature{T, std::copysign(distance(p), c.v - p.v)};
}

}  // namespace iride
