// SPDX-License-Identifier: Apache-2.0
#include "materials/coat_albedo.h"

#include "materials/fresnel.h"

namespace iride {

namespace {

// R of every column at one cosine. Midpoint rule over the unit square of visible normals; the half turn of azimuths
// mirrors the other half. The steep facets next to y = 1 are resolved by y = 1 - t^3.
std::vector<double> quadrature(Ggx ggx, double cosine, std::vector<double> const& indices) {
    constexpr int azimuths = 48, heights = 64;
    constexpr double least_cosine = 1e-6;  // stands for 0, where the visible normals have their limit
    double const mu = std::max(cosine, least_cosine);
    Direction const wo(static_cast<float>(std::sqrt((1 - mu) * (1 + mu))), 0, static_cast<float>(mu));
    float const lambda_o = ggx.lambda(wo);
    std::vector<double> sum(indices.size());
    for (int i = 0; i < azimuths; ++i)
        for (int j = 0; j < heights; ++j) {
            float const turn = (static_cast<float>(i) + 0.5f) / (2 * azimuths);
            float const t = (static_cast<float>(j) + 0.5f) / heights;
            Direction const h = ggx.visible_normal(wo, {0, {turn, 1 - t * t * t}});
            float const incidence = std::clamp(wo.dot(h), 0.0f, 1.0f);
            Direction const wi = 2 * incidence * h - wo;
            if (!(wi.z() > 0)) continue;
            auto const kept = static_cast<double>(3 * t * t * (1 + lambda_o) / (1 + lambda_o + ggx.lambda(wi)));
            for (std::size_t k = 0; k < indices.size(); ++k)
                sum[k] += kept * fresnel(static_cast<double>(incidence), indices[k], 0.0).unpolarised();
        }
    for (double& s : sum) s /= azimuths * heights;
    return sum;
}

// A(a). Beyond the critical angle F = 1; what is nearer to the normal is summed over its cosine outside, for mu dmu =
// mu_o dmu_o / n^2 and F is the same on both sides. Midpoint rule, to 1e-4 of the value.
double smooth_round_trip(double n, double optical_depth) {
    constexpr int steps = 256;
    double const n2 = square(n), critical = std::sqrt(1 - 1 / n2);  // cosine
    double total = 0, partial = 0;
    for (int i = 0; i < steps; ++i) {
        double const x = (i + 0.5) / steps, cosine = std::sqrt(1 - (1 - square(x)) / n2);
        total += square(critical) * x * std::exp(-2 * optical_depth / (critical * x));
        partial += fresnel(x, n, 0.0).unpolarised() * x * std::exp(-2 * optical_depth / cosine) / n2;
    }
    return 2 * (total + partial) / steps;
}

}  // namespace

CoatAlbedo::CoatAlbedo(Ggx ggx, double least, double most)
    : column_count_(most > least ? 17 : 1), least_(static_cast<float>(least)), bend_(2 * ggx.alpha_x + 0.1f) {
    double const step = column_count_ == 1 ? 1 : (most - least) / (column_count_ - 1);
    columns_per_n_ = static_cast<float>(1 / step);
    std::vector<double> indices;
    for (int c = 0; c < column_count_; ++c) indices.push_back(least + c * step);
    mean_.resize(indices.size());
    for (int i = 0; i <= cells; ++i) {
        double const x = square(static_cast<double>(i) / cells), bend = static_cast<double>(bend_);
        double const cosine = bend * x / (1 + bend - x);
        cosine_.push_back(static_cast<float>(cosine));
        for (double const R : quadrature(ggx, cosine, indices)) value_.push_back(static_cast<float>(R));
        if (i == 0) continue;
        // int 2 mu R over a cell where R is linear.
        double const a = static_cast<double>(cosine_[cosine_.size() - 2]), width = cosine - a;
        std::size_t const now = value_.size() - indices.size();
        for (std::size_t c = 0; c < indices.size(); ++c) {
            double const first = static_cast<double>(value_[now - indices.size() + c]);
            double const rise = static_cast<double>(value_[now + c]) - first;
            mean_[c] += width * (2 * a * first + a * rise + width * (first + 2 * rise / 3));
        }
    }
}

double CoatAlbedo::mean(double n) const {
    if (column_count_ == 1) return mean_[0];
    double const x =
        std::clamp((n - static_cast<double>(least_)) * static_cast<double>(columns_per_n_), 0.0, column_count_ - 1.0);
    auto const c = static_cast<std::size_t>(std::min(static_cast<int>(x), column_count_ - 2));
    return mean_[c] + (x - static_cast<double>(c)) * (mean_[c + 1] - mean_[c]);
}

double internal_reflectance(double n, double outside, double optical_depth) {
    double const clear = 1 - (1 - outside) / square(n);
    if (optical_depth == 0 || !(n > 1)) return clear;
    return clear * smooth_round_trip(n, optical_depth) / smooth_round_trip(n, 0);
}

}  // namespace iride
