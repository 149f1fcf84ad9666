// SPDX-License-Identifier: Apache-2.0
// Rough diffuse surfaces: Oren and Nayar's model in the reciprocal, energy-preserving form. r: roughness, 0 .. 1,
//   f    = rho A (1 + r s/t) / pi + rho_m A r g(wo) g(wi) / (pi (c1 - c2)),    A = 1 / (1 + c1 r)
//   s    = <wo, wi> - cos wo cos wi,   t = max(cos wo, cos wi) for s > 0, else 1
//   g(w) = c1 - G(w) / pi: A r g is what one bounce loses,   rho_m = rho^2 E / (1 - rho (1 - E)),  E = A (1 + c2 r)
//   c1 = 1/2 - 2/(3 pi), c2 = 2/3 - 28/(15 pi); G is below.  [Fujii 2012] [Portsmouth 2025, secs. 2 and 3]
// White stays white and r = 0 is Lambert's law, both exactly.
#pragma once

#include "base/warp.h"
#include "materials/bsdf.h"

namespace iride {

// Sampled from what it is made of: towards the viewer's side the excess r s/t goes as cos(azimuth) min(1, cos wi / cos
// wo), which is drawn as it stands (without the sine of wi); the rest by the cosine. 0 <= weight <= 1.3 (tested).
struct OrenNayar {
    static constexpr bool has_density = true;
    Lanes reflectance;
    float roughness;

    BsdfEvaluation evaluate(Direction const& wo, Direction const& wi) const {
        if (!(wo.z() > edge_on && wi.z() > edge_on)) return {};
        Slant const o(wo);
        return evaluate(wo, o, share_of_excess(o), wi);
    }

    std::optional<BsdfSample> sample(Direction const& wo, Sample3 u) const {
        if (!(wo.z() > edge_on)) return std::nullopt;
        Slant const o(wo);
        float const excess = share_of_excess(o);
        Direction const wi = u.lobe < excess ? towards_viewer(wo, o, u.direction) : to_cosine_hemisphere(u.direction);
        if (!(wi.z() > edge_on)) return std::nullopt;  // probability 0
        BsdfEvaluation const e = evaluate(wo, o, excess, wi);
        PerSteradian const density(e.density[0]);
        return std::optional<BsdfSample>(std::in_place, wi, Throughput(e.value.lane * (wi.z() / density.value)),
                                         Lanes(1), density);
    }

  private:
    static constexpr float c1 = 0.5f - 2 / (3 * pi), c2 = 2.0f / 3 - 28 / (15 * pi);

    // A direction's sine and the two parts of G(w) = excess - deficit: pi times the mean of s/t where s > 0, and of -s
    // where s < 0. No difference of nearly equal numbers at grazing incidence.
    struct Slant {
        float sine, excess, deficit;
        explicit Slant(Direction const& w) : sine(std::sqrt(square(w.x()) + square(w.y()))), deficit(2.0f / 3 * sine) {
            float const mu = w.z(), angle = arctangent(sine, mu);
            float const cube = mu * (1 + sine + square(sine)) / (1 + sine);  // (1 - sine^3) / mu
            excess = sine * (angle - sine * mu + 2.0f / 3 * cube);
        }
        float lost() const { return std::max(0.0f, c1 - (excess - deficit) * inverse_pi); }  // g
    };

    float scale() const { return 1 / (1 + c1 * roughness); }  // A
    // The directional albedo of the excess for rho = 1.
    float share_of_excess(Slant const& o) const { return scale() * roughness * inverse_pi * o.excess; }

    BsdfEvaluation evaluate(Direction const& wo, Slant const& o, float excess, Direction const& wi) const {
        Slant const i(wi);
        float const A = scale(), s = std::max(-1.0f, wo.x() * wi.x() + wo.y() * wi.y());  // but for rounding
        float const once = A * (1 + roughness * (s > 0 ? s / std::max(wo.z(), wi.z()) : s)) * inverse_pi;
        float const often = A * roughness * o.lost() * i.lost() * (inverse_pi / (c1 - c2));
        float const mean = A * (1 + c2 * roughness);  // E
        Lanes const several = reflectance * reflectance * mean / (Lanes(1) - reflectance * (1 - mean));
        float density = (1 - excess) * wi.z() * inverse_pi;
        float const sines = o.sine * i.sine;
        if (s > 0 && sines > 0) density += excess * s / sines * std::min(1.0f, wi.z() / wo.z()) / (2 - wo.z());
        return {BsdfValue((reflectance * once + several * often).lane), LaneDensity(density)};
    }

    // Density cos(azimuth) min(1, cos wi / cos wo) / (2 - cos wo), azimuth against wo's, within a quarter turn.
    static Direction towards_viewer(Direction const& wo, Slant const& o, Sample2 u) {
        float const mu = wo.z(), area = u.x * (1 - mu / 2);
        float const z = area < mu / 2 ? std::sqrt(2 * mu * area) : area + mu / 2;
        float const across = 2 * u.y - 1, along = std::sqrt(std::max(0.0f, 1 - square(across)));
        float const r = std::sqrt(std::max(0.0f, 1 - square(z))) / o.sine;
        return {r * (along * wo.x() - across * wo.y()), r * (along * wo.y() + across * wo.x()), z};
    }
};

}  // namespace iride
