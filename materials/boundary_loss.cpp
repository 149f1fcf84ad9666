// SPDX-License-Identifier: Apache-2.0
#include "materials/boundary_loss.h"

namespace iride {

BoundaryLoss::BoundaryLoss(Facets const& facets, double eta_min, double eta_max)
    : eta_min_(static_cast<float>(eta_min)), eta_max_(static_cast<float>(eta_max)), rows_per_eta_(0) {
    std::size_t count = 1;
    if (eta_max > eta_min) {
        count = std::min(max_rows, 2 + static_cast<std::size_t>((eta_max - eta_min) / row_distance));
        rows_per_eta_ = static_cast<float>(static_cast<double>(count - 1) / (eta_max - eta_min));
    }
    for (std::size_t i = 0; i < count; ++i) {
        double const eta = i == 0 ? eta_min : eta_min + static_cast<double>(i) / static_cast<double>(rows_per_eta_);
        rows_.push_back({shared_facet_loss(facets, eta), shared_facet_loss(facets, 1 / eta)});
    }
}

BoundaryLoss::Place BoundaryLoss::place_of(Lanes eta) const {
    Place place{};
    if (rows_.size() == 1) return place;
    float const last = static_cast<float>(rows_.size() - 1);
    for (int i = 0; i < lane_count; ++i) {
        float const x = std::clamp((eta[i] - eta_min_) * rows_per_eta_, 0.0f, last);
        place.row[i] = std::min(static_cast<int>(x), static_cast<int>(rows_.size()) - 2);
        place.fraction[i] = x - static_cast<float>(place.row[i]);
    }
    return place;
}

Direction BoundaryLoss::sample(bool outside, Place const& place, float choice, Sample2 u) const {
    auto const row = static_cast<std::size_t>(place.row[0]);
    FacetLoss const& first = rows_[row].side(outside);
    if (rows_.size() == 1) return first.sample(u);
    FacetLoss const& second = rows_[row + 1].side(outside);
    float const a = (1 - place.fraction[0]) * first.mean(), b = place.fraction[0] * second.mean();
    return choice * (a + b) < a ? first.sample(u) : second.sample(u);
}

}  // namespace iride
