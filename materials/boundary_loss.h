// SPDX-License-Identifier: Apache-2.0
// What rough facets of a transparent boundary lose at the first bounce (FacetLoss), seen from both sides and over a
// range of relative indices eta = n(inside) / n(outside): linear in eta between rows `row_distance` apart or less. What
// is linear is a mixture: a direction of density ~ loss is drawn from one of the two rows.
#pragma once

#include <array>

#include "materials/facet_loss.h"
#include "spectral/wavelengths.h"

namespace iride {

class BoundaryLoss {
  public:
    // 0 < eta_min <= eta_max.
    BoundaryLoss(Facets const& facets, double eta_min, double eta_max);

    float eta_max() const { return eta_max_; }

    // Where the lanes' eta lies among the rows; beyond the range: at its end.
    struct Place {
        LaneIndex row;
        LaneRegister fraction;
    };
    Place place_of(Lanes eta) const;

    Lanes loss(bool outside, Direction const& w, Place const& place) const;
    Lanes mean(bool outside, Place const& place) const;
    // A direction, z >= 0, of density loss w.z / (pi mean) for the hero's eta.
    Direction sample(bool outside, Place const& place, float choice, Sample2 u) const;

  private:
    static constexpr std::size_t max_rows = 16;
    static constexpr double row_distance = 0.05;
    struct Row {
        std::shared_ptr<FacetLoss const> from_outside, from_inside;
        FacetLoss const& side(bool outside) const { return outside ? *from_outside : *from_inside; }
    };
    template <class Value>
    Lanes interpolated(Place const& place, Value&& value) const;

    std::vector<Row> rows_;
    float eta_min_, eta_max_, rows_per_eta_;
};

template <class Value>
Lanes BoundaryLoss::interpolated(Place const& place, Value&& value) const {
    if (rows_.size() == 1) return Lanes(value(rows_[0]));
    std::array<float, max_rows> values;
    for (std::size_t i = 0; i < rows_.size(); ++i) values[i] = value(rows_[i]);
    Lanes result;
    for (int i = 0; i < lane_count; ++i) {
        float const* const row = values.data() + place.row[i];
        result.lane[i] = row[0] + place.fraction[i] * (row[1] - row[0]);
    }
    return result;
}

inline Lanes BoundaryLoss::loss(bool outside, Direction const& w, Place const& place) const {
    return interpolated(place, [&](Row const& row) { return row.side(outside).loss(w); });
}
inline Lanes BoundaryLoss::mean(bool outside, Place const& place) const {
    return interpolated(place, [&](Row const& row) { return row.side(outside).mean(); });
}

}  // namespace iride
