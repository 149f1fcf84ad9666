// SPDX-License-Identifier: Apache-2.0
// A rough boundary between two transparent media. With eta = n(side of wi) / n(side of wo) for the lane and cosines o,
// i against the facet's normal h (a half vector: of the lane, in refraction), once scattered light has
//   reflection:  p = F(o) D(h) G2 / (4 cos wo),                                   h ~ wo + wi
//   refraction:  p = (1 - F(o)) D(h) G1(wo) G1(wi) o |i| eta^2 / (cos wo |wo + eta wi|^2),   h ~ -+(wo + eta wi)
// What that loses comes back as Kulla's and Conty's lobe, in the measure n^2 cos dw of both hemispheres together, in
// which transport through a boundary is symmetric:
//   m = n_i^2 loss(wo) loss(wi) / (pi (n_o^2 mean_o + n_i^2 mean_i)) cos wi,  losses seen from the side of each
// p + m is the density of wi and integrates to 1; f = (p + m) / (eta^2 cos wi), without eta in reflection. Exact:
// energy, to the tables' error, and reciprocity, f / n_o^2 symmetric. Approximate: the shape of m, and how much of it
// crosses. [Walter 2007, secs. 5.2 and 5.3] [Kulla 2017] [Veach 1997, sec. 5.2]
#pragma once

#include "materials/boundary_loss.h"
#include "materials/bsdf.h"
#include "materials/fresnel.h"

namespace iride {

template <FacetModel FacetType>
struct RoughDielectric {
    static constexpr bool has_density = true;
    Lanes inside, outside;  // n of the body (z < 0) and of what surrounds it (z > 0)
    FacetType facets;
    BoundaryLoss const* loss;  // of the same facets; outlives this

    BsdfEvaluation evaluate(Direction const& wo, Direction const& wi) const {
        View const view = view_from(wo);
        Lanes const p = density(view, wo, wi);
        float const cosine = std::abs(wi.z());
        if (!(cosine > edge_on)) return {};
        Lanes const f = p / cosine;
        return {BsdfValue((view.reflects(wi) ? f : f / (view.eta * view.eta)).lane), LaneDensity(p.lane)};
    }

    std::optional<BsdfSample> sample(Direction const& wo, Sample3 u) const {
        if (std::abs(wo.z()) <= edge_on) return std::nullopt;
        View const view = view_from(wo);
        Sample3 rest = u;
        Direction wi;
        float const kept = scatter_once(view.eta[0], view.upright(wo), rest, wi);
        if (rest.lobe >= kept) {
            Sample2 const further = further_numbers(u);
            float const here = loss->mean(view.outside, view.place)[0];
            float const there = square(view.eta[0]) * loss->mean(!view.outside, view.place)[0];
            float const share = here / (here + there);
            bool const stays = further.y < share;
            float const choice = stays ? further.y / share : (further.y - share) / (1 - share);
            wi = loss->sample(stays == view.outside, view.place, choice, {(rest.lobe - kept) / (1 - kept), further.x});
            if (!stays) wi.z() = -wi.z();
        }
        wi = view.upright(wi);
        Lanes const p = density(view, wo, wi);
        if (!(p[0] > 0)) return std::nullopt;
        Lanes const reach = p * (1 / p[0]);
        return std::optional<BsdfSample>(std::in_place, wi, view.reflects(wi) ? reach : reach / (view.eta * view.eta),
                                         reach, PerSteradian(p[0]));
    }

  private:
    // The boundary as wo sees it.
    struct View {
        bool outside;
        Lanes near, far, eta;  // n of the side of wo, of the other, and the ratio far / near
        BoundaryLoss::Place place;

        bool reflects(Direction const& wi) const { return (wi.z() > 0) == outside; }
        // With the side of wo on top; its own inverse. The facets are point symmetric, so they stay the same.
        Direction upright(Direction const& w) const { return outside ? w : Direction(w.x(), w.y(), -w.z()); }
    };
    View view_from(Direction const& wo) const {
        // Equal indices are no boundary: they are kept apart, so that half vectors have a direction.
        constexpr float least_contrast = 1e-3f;
        Lanes body = inside;
        for (int i = 0; i < lane_count; ++i) {
            float const contrast = inside[i] - outside[i], least = least_contrast * outside[i];
            if (std::abs(contrast) < least) body.set(i, outside[i] + std::copysign(least, contrast));
        }
        bool const from_outside = wo.z() > 0;
        Lanes const near = from_outside ? outside : body, far = from_outside ? body : outside;
        return {from_outside, near, far, far / near, loss->place_of(body / outside)};
    }

    // Where one facet sends light, wo.z > 0, and with which probability it gets away; rest.lobe is a number in [0, 1).
    float scatter_once(float eta, Direction const& wo, Sample3& rest, Direction& wi) const {
        Direction const h = facets.visible_normal(wo, rest);
        float const cosine = std::min(1.0f, wo.dot(h)), F = fresnel(cosine, eta, 0.0f).unpolarised();
        bool const reflected = rest.lobe < F;
        rest.lobe = std::min(reflected ? rest.lobe / F : (rest.lobe - F) / (1 - F), one_minus_epsilon);
        if (reflected) {
            wi = unit(2 * cosine * h - wo);
            float const lambda_o = facets.lambda(wo, h);
            return wi.z() > edge_on ? (1 + lambda_o) / (1 + facets.joint(lambda_o, facets.lambda(wi, h))) : 0;
        }
        float const relative = 1 / eta, sine2 = (1 - square(cosine)) * square(relative);
        wi = unit((relative * cosine - std::sqrt(std::max(0.0f, 1 - sine2))) * h - relative * wo);
        return wi.z() < -edge_on ? 1 / (1 + facets.lambda(wi, h)) : 0;
    }

    // p + m of each lane [1/sr]
    Lanes density(View const& view, Direction const& wo_given, Direction const& wi_given) const {
        Direction const wo = view.upright(wo_given), wi = view.upright(wi_given);
        if (!(wo.z() > edge_on) || !(std::abs(wi.z()) > edge_on)) return {};
        bool const reflects = wi.z() > 0;
        Lanes const eta2 = view.eta * view.eta;
        Lanes const means = loss->mean(view.outside, view.place) + eta2 * loss->mean(!view.outside, view.place);
        Lanes const losses =
            loss->loss(view.outside, wo, view.place) * loss->loss(reflects == view.outside, wi, view.place);
        Lanes const often = losses / means * (std::abs(wi.z()) * inverse_pi);
        if (reflects) return reflected(view.eta, wo, wi) + often;
        return refracted(view, wo, wi) + often * eta2;
    }

    Lanes reflected(Lanes const& eta, Direction const& wo, Direction const& wi) const {
        Direction const h = unit(wo + wi);
        float const joint = facets.joint(facets.lambda(wo, h), facets.lambda(wi, h));
        return fresnel_unpolarised(std::min(1.0f, wo.dot(h)), eta, Lanes(0)) *
               (facets.distribution(h).value / (4 * wo.z() * (1 + joint)));
    }

    Lanes refracted(View const& view, Direction const& wo, Direction const& wi) const {
        if (is_black(view.near - Lanes(view.near[0])) && is_black(view.far - Lanes(view.far[0])))
            return Lanes(refracted(view.near[0], view.far[0], wo, wi));
        Lanes result;
        for (int i = 0; i < lane_count; ++i) result.lane[i] = refracted(view.near[i], view.far[i], wo, wi);
        return result;
    }
    // Half vector and cosines are found in double, and Fresnel's equations on the side of lower index, where angles
    // are larger: so light and viewer may change places though D is steep and the critical angle near.
    float refracted(float near, float far, Direction const& wo, Direction const& wi) const {
        VectorDouble const sum = wo.cast<double>() * near + wi.cast<double>() * far;
        VectorDouble const half = sum / std::copysign(sum.norm(), sum.z());
        auto const o = static_cast<float>(half.dot(wo.cast<double>()));
        auto const i = static_cast<float>(-half.dot(wi.cast<double>()));
        Direction const h = half.cast<float>();
        if (!(o > 0 && i > 0 && h.z() > 0)) return 0;
        bool const thin = near < far;
        float const F = fresnel(std::min(1.0f, thin ? o : i), thin ? far / near : near / far, 0.0f).unpolarised();
        float const seen = (1 + facets.lambda(wo, h)) * (1 + facets.lambda(wi, h));
        auto const size2 = static_cast<float>(sum.squaredNorm());
        return (1 - F) * facets.distribution(h).value * o * i * square(far) / (wo.z() * size2 * seen);
    }
};

}  // namespace iride
