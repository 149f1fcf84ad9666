// SPDX-License-Identifier: Apache-2.0
#include "materials/ggx_albedo.h"

namespace iride {

namespace {

// Midpoint rule over the unit square of visible normals; the half turn of azimuths mirrors the other half. The steep
// facets, the share ~ alpha^2 next to y = 1 that throws light down, are resolved by y = 1 - t^3.
double quadrature(Ggx ggx, double cosine) {
    constexpr int azimuths = 48, heights = 64;
    Direction const wo(static_cast<float>(std::sqrt((1 - cosine) * (1 + cosine))), 0, static_cast<float>(cosine));
    float const lambda_o = ggx.lambda(wo);
    double sum = 0;
    for (int i = 0; i < azimuths; ++i)
        for (int j = 0; j < heights; ++j) {
            float const turn = (static_cast<float>(i) + 0.5f) / (2 * azimuths);
            float const t = (static_cast<float>(j) + 0.5f) / heights;
            Direction const h = ggx.visible_normal(wo, {turn, 1 - t * t * t});
            Direction const wi = 2 * wo.dot(h) * h - wo;
            float const lambda_i = ggx.lambda(wi);
            float const lost = wi.z() > 0 ? lambda_i / (1 + lambda_o + lambda_i) : 1;
            sum += static_cast<double>(3 * t * t * lost);
        }
    return sum / (azimuths * heights);
}

// int of 2 mu loss(mu) over the first `width` of a cell where loss = first + slope (mu - start).
float weighted_area(float start, float first, float slope, float width) {
    return width * (2 * start * first + width * (start * slope + first + width * slope * (2.0f / 3)));
}

}  // namespace

GgxAlbedo::GgxAlbedo(Ggx ggx) : bend_(2 * ggx.alpha) {
    knots_[0] = {0, 0, 0};  // E(0) = 1: at grazing no reflected ray is blocked more than the incident one
    for (std::size_t i = 1; i <= cells; ++i) {
        double const x = square(static_cast<double>(i) / cells), bend = static_cast<double>(bend_);
        double const cosine = i == cells ? 1 : bend * x / (1 + bend - x);
        Knot const before = knots_[i - 1];
        Knot& k = knots_[i];
        k.cosine = static_cast<float>(cosine);
        k.loss = static_cast<float>(quadrature(ggx, cosine));
        float const width = k.cosine - before.cosine;
        k.cumulative =
            before.cumulative + weighted_area(before.cosine, before.loss, (k.loss - before.loss) / width, width);
    }
    mean_loss_ = knots_.back().cumulative;
}

float GgxAlbedo::sample_cosine(float u) const {
    float const target = u * mean_loss_;
    auto const above = std::ranges::upper_bound(knots_.begin() + 1, knots_.end() - 1, target, {}, &Knot::cumulative);
    Knot const &a = *(above - 1), &b = *above;
    float const width = b.cosine - a.cosine, slope = (b.loss - a.loss) / width;
    float const wanted = std::max(0.0f, target - a.cumulative);
    float x = width * std::cbrt(std::min(1.0f, wanted / (b.cumulative - a.cumulative)));  // exact in the first cell
    for (int newton = 0; newton < 5; ++newton) {  // of a nearly straight cubic: to the last bits
        float const derivative = 2 * (a.cosine + x) * (a.loss + slope * x);
        if (!(derivative > 0)) break;
        x = std::clamp(x - (weighted_area(a.cosine, a.loss, slope, x) - wanted) / derivative, 0.0f, width);
    }
    return a.cosine + x;
}

}  // namespace iride
