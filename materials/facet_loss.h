// SPDX-License-Identifier: Apache-2.0
// What microfacets that absorb nothing lose at the first bounce: light that meets another facet on its way out, which
// single scattering drops. For facets h drawn from those that w sees (the direction it goes on in is wi):
//   loss(w) = <1 - G2(w, wi, h) / G1(w, h)>, G2 = 0 on the wrong side of the surface
//           = sum_j w_j int (1 + (w.x p + w.y q) / w.z)+ P_j(p, q) (G1 - G2) dp dq,     h ~ (p, q, 1)
//   mean    = (1 / pi) int loss(w) w.z dw over the hemisphere
// Mirrors, or boundaries to a medium of relative index eta, where wi is reflected with probability F, else refracted.
// Piecewise linear in the cosine, and in the azimuth for anisotropic facets; made by quadrature at load. |table - loss|
// < 2e-3 (tested); mean and sample() are exact for the table, so that is also the error of the energy.
// [Kulla 2017] [Heitz 2014]
#pragma once

#include <bit>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "materials/facets.h"

namespace iride {

class FacetLoss {
  public:
    // eta = n(far side) / n(side of w); absent: mirrors.
    explicit FacetLoss(Facets const& facets, std::optional<double> eta = std::nullopt);

    // w on either side of z = 0, as on the other.
    float loss(Direction const& w) const {
        Place const place = place_of(std::abs(w.z()));
        if (rows_.size() == 1) return loss_in(rows_[0], place);
        return loss_between_rows(w, place);
    }
    float mean() const { return mean_; }
    // A direction, z >= 0, of density loss(w) w.z / (pi mean).
    Direction sample(Sample2 u) const;

  private:
    struct Knot {
        float loss;
        float cumulative;  // int_0^cosine 2 mu loss(mu) dmu
    };
    // One azimuth, 0 .. pi / 2: between rows the loss is linear in the azimuth.
    struct Row {
        float azimuth;
        float cumulative_share;  // of mean_, of this row and those before
        std::vector<Knot> knots;
    };
    struct Place {
        std::size_t cell;
        float fraction;
    };

    // Sixteen cells to each octave of s = first_ + (1 - first_) cosine: the cell and the place in it are the bits of s.
    // first_ is a power of 2, below the smallest roughness: the loss varies with cosine / alpha.
    static constexpr int bits_of_place = 23 - 4;
    Place place_of(float cosine) const {
        auto const bits = std::bit_cast<std::uint32_t>(first_ + (1 - first_) * cosine) - first_bits_;
        constexpr std::uint32_t mask = (1u << bits_of_place) - 1;
        std::uint32_t const inside = std::min(bits, last_bits_);
        return {inside >> bits_of_place, static_cast<float>(static_cast<std::int32_t>(inside & mask)) * 0x1p-19f};
    }
    float cosine_of(std::size_t knot) const {
        auto const bits = first_bits_ + (static_cast<std::uint32_t>(knot) << bits_of_place);
        return (std::bit_cast<float>(bits) - first_) / (1 - first_);
    }
    static float loss_in(Row const& row, Place place) {
        float const a = row.knots[place.cell].loss, b = row.knots[place.cell + 1].loss;
        return a + place.fraction * (b - a);
    }
    float loss_between_rows(Direction const& w, Place place) const;
    Row make_row(Facets const& facets, std::optional<double> eta, double azimuth) const;
    float sample_cosine(Row const& row, float u) const;
    float sample_azimuth(std::size_t row, float u) const;

    float first_;
    std::uint32_t first_bits_, last_bits_;
    std::vector<Row> rows_;  // one, if isotropic
    float mean_ = 0;
};

// Materials of the same facets share one table.
std::shared_ptr<FacetLoss const> shared_facet_loss(Facets const& facets, std::optional<double> eta = std::nullopt);

// Two more numbers, as good as independent of u: a hash of all its bits.
Sample2 further_numbers(Sample3 const& u);

}  // namespace iride
