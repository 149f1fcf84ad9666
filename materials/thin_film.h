// SPDX-License-Identifier: Apache-2.0
// A stack of thin plane layers on a substrate: reflectance and transmittance of power at one wavelength and angle, by
// Rouard's recursion from the substrate up, which is the transfer matrix without its growing exponentials:
//   e = exp(2 pi i q d / lambda),   r <- (r' + r e^2) / (1 + r' r e^2),   t <- t' t e / (1 + r' r e^2)
// r', t' are the amplitudes of the layer's upper boundary and q its normal component; |e| <= 1, however thick or
// absorbing the layer. Layers are coherent. [Born 1999, sec. 1.6] [Macleod 2017, ch. 2]
#pragma once

#include <numbers>
#include <span>

#include "materials/fresnel.h"

namespace iride {

template <class Real>
struct ThinLayer {
    std::complex<Real> N;  // n + ik, n > 0, k >= 0
    Real thickness_nm;     // >= 0
};

// Of power, through planes parallel to the surface: R + T = 1 where nothing absorbs.
template <class Real>
struct StackPower {
    FresnelReflectance<Real> R, T;
};

// `layers` from outside to inside, between a transparent medium of index n0 > 0 and a substrate. cosine in [0, 1],
// outside; where 1 + r is lost in rounding the stack is the mirror that every boundary is at grazing incidence.
template <class Real>
StackPower<Real> thin_film(Real cosine, Real n0, std::span<ThinLayer<Real> const> layers, std::complex<Real> substrate,
                           Real wavelength_nm) {
    using Complex = std::complex<Real>;
    constexpr Real grazing = 4 * std::numeric_limits<Real>::epsilon();
    if (cosine < grazing) return {{1, 1}, {0, 0}};
    Real const S2 = n0 * n0 * (1 - cosine) * (1 + cosine);
    WaveMedium<Real> const outside{Complex(n0), Complex(n0 * cosine)}, bottom = wave_medium(substrate, S2);
    auto const medium = [&](std::size_t i) { return i == 0 ? outside : wave_medium(layers[i - 1].N, S2); };

    WaveMedium<Real> lower = medium(layers.size());
    FresnelAmplitudes<Real> below = fresnel_amplitudes(lower, bottom);
    for (std::size_t i = layers.size(); i > 0; --i) {
        WaveMedium<Real> const upper = medium(i - 1);
        FresnelAmplitudes<Real> const b = fresnel_amplitudes(upper, lower);
        Complex const phase = 2 * std::numbers::pi_v<Real> * layers[i - 1].thickness_nm / wavelength_nm * lower.q;
        Complex const e = std::polar(std::exp(-phase.imag()), phase.real()), e2 = e * e;
        Complex const echoes_s = Real(1) + b.r_s * below.r_s * e2, echoes_p = Real(1) + b.r_p * below.r_p * e2;
        below = {(b.r_s + below.r_s * e2) / echoes_s, (b.r_p + below.r_p * e2) / echoes_p,
                 b.t_s * below.t_s * e / echoes_s, b.t_p * below.t_p * e / echoes_p};
        lower = upper;
    }
    Real const flux_s = bottom.q.real() / outside.q.real();
    Real const flux_p = (bottom.q * std::conj(substrate) / substrate).real() / outside.q.real();
    return {{std::norm(below.r_s), std::norm(below.r_p)},
            {flux_s * std::norm(below.t_s), flux_p * std::norm(below.t_p)}};
}

}  // namespace iride
