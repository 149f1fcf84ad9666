// SPDX-License-Identifier: Apache-2.0
// What a GGX surface of perfect mirrors (F = 1) loses at the first bounce: light that meets another facet on its way
// out, which single scattering drops.
//   loss(mu)  = 1 - E(mu) = <1 - G2 / G1> over the visible normals,  G2 = 0 for directions into the surface
//   mean_loss = 1 - E_avg = 2 int_0^1 loss(mu) mu dmu
// One roughness, cosines alone: piecewise linear between knots made by quadrature at load. The knots crowd where
// mu <~ alpha. |table - loss| < 3e-4 for alpha .001 .. 1 (tested); mean_loss and sample_cosine are exact for the table,
// so that is also the error of the energy. [Kulla 2017] [Dupuy 2023]
#pragma once

#include <array>

#include "materials/microfacet.h"

namespace iride {

class GgxAlbedo {
  public:
    explicit GgxAlbedo(Ggx ggx);

    // 1 - E(cosine), cosine in [0, 1].
    float loss(float cosine) const {
        auto const cell = std::min(cells - 1, static_cast<std::size_t>(cells * place(cosine)));
        Knot const &a = knots_[cell], &b = knots_[cell + 1];
        return a.loss + (cosine - a.cosine) * (b.loss - a.loss) / (b.cosine - a.cosine);
    }
    // 1 - E_avg.
    float mean_loss() const { return mean_loss_; }
    // A cosine of density 2 cosine loss(cosine) / mean_loss on [0, 1].
    float sample_cosine(float u) const;

  private:
    // Place of a cosine among the equally spaced knots, 0 .. 1: the loss varies with mu / alpha, steepest at 0.
    float place(float cosine) const { return std::sqrt(cosine * (1 + bend_) / (cosine + bend_)); }

    static constexpr std::size_t cells = 128;
    struct Knot {
        float cosine, loss;
        float cumulative;  // int_0^cosine 2 mu loss(mu) dmu
    };
    std::array<Knot, cells + 1> knots_;
    float bend_, mean_loss_;
};

}  // namespace iride
