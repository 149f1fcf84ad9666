// SPDX-License-Identifier: Apache-2.0
// A surface point that two subpaths may meet at, met from direction `back`, and how it scatters between any two
// directions. Values and densities are always those of a viewer's ray, so all techniques measure the same light:
//   radiance towards v:   L(v) = int f(v, w) |w.n_s| L(w) dw
//   power arriving along -w and leaving towards v is the same kernel read backwards: in place of |w.n_s| it has
//                         f(v, w) |w.n_s| |v.n_g| / |w.n_g|                              [Veach 1997, sec. 5.3]
//   through a Dirac lobe, sampled from the light's side: the weight of a viewer's ray that comes along w, times
//                         (n_v / n_w)^2 |w.n_s| |v.n_g| / (|w.n_g| |v.n_s|)
// with n_s the shading and n_g the geometric normal, n_v and n_w the indices: radiance is scaled by the squared ratio
// of the indices at a boundary, power is not. [Veach 1997, sec. 5.2]
#pragma once

#include "integrators/scattering.h"
#include "scene/bodies.h"

namespace iride {

// |w.n_s| |v.n_g| / (|w.n_g| |v.n_s|).
inline float shading_adjoint(Direction const& w, Direction const& v, Direction const& shading,
                             Direction const& geometric) {
    return std::abs(w.dot(shading)) * std::abs(v.dot(geometric)) /
           (std::abs(w.dot(geometric)) * std::abs(v.dot(shading)));
}

struct Scattering {
    BsdfValue value;      // f(viewer, wi)
    LaneDensity density;  // of wi, as sampled for the viewer
    float cosine;         // |wi.n_s|
};

class Meeting {
  public:
    // `in`: what the path from there is in; absent if every surface knows what lies before it and nothing absorbs.
    Meeting(Scene const& scene, Hit const& met, Direction const& to_previous, Wavelengths const& wavelengths,
            float choice, std::optional<Surroundings> const& in)
        : hit_(described(met, to_previous, choice)),
          back_(to_previous),
          in_(in),
          seen_(scene, hit_, back_, wavelengths, in_ ? &*in_ : nullptr),
          flat_(is_flat(hit_.point)),
          two_sided_(scene.material(hit_.shape->material).traits.two_sided) {}

    Hit const& hit() const { return hit_; }
    SurfacePoint const& point() const { return hit_.point; }
    Direction const& back() const { return back_; }
    Interaction const& seen() const { return seen_; }  // from `back`
    float cosine(Direction const& w) const { return std::abs(w.dot(hit_.point.geometric_normal)); }

    Scattering scattering(Scene const& scene, Wavelengths const& wavelengths, Direction const& viewer,
                          Direction const& wi) const {
        if (is_seen_alike(viewer)) return evaluate(seen_, viewer, wi);
        Hit const turned = described(hit_, viewer, hit_.point.choice);
        std::optional<Surroundings> const in = beside(scene, viewer);
        return evaluate(Interaction(scene, turned, viewer, wavelengths, in ? &*in : nullptr), viewer, wi);
    }
    // That with which a path from w would have gone back.
    Lanes density_back(Scene const& scene, Wavelengths const& wavelengths, Direction const& w) const {
        return Lanes(scattering(scene, wavelengths, w, back_).density.lane);
    }
    // What a path along w is in.
    std::optional<Surroundings> beside(Scene const& scene, Direction const& w) const {
        std::optional<Surroundings> in = in_;
        Body const* const body = in ? body_at(scene, hit_) : nullptr;
        if (body && is_in_front(back_) != is_in_front(w)) in->cross(*body, is_in_front(back_));
        return in;
    }
    // What is left of light along w, so far and without a surface.
    Throughput let_through(Scene const& scene, Wavelengths const& wavelengths, Direction const& w,
                           float distance) const {
        return in_ ? beside(scene, w)->medium().transmittance(distance, wavelengths) : Throughput(1);
    }
    // |w.n_s| |v.n_g| / |w.n_g| for light that arrives from w and goes on to v, given |w.n_s|.
    float adjoint_cosine(float shading_cosine, Direction const& w, Direction const& v) const {
        return flat_ ? cosine(v) : shading_cosine * cosine(v) / cosine(w);
    }
    // The same through a Dirac lobe from `back` to v, relative to the weight of a viewer's ray; without indices.
    float adjoint_of_dirac(Direction const& v) const {
        return flat_ ? 1 : shading_adjoint(back_, v, seen_.frame.normal, hit_.point.geometric_normal);
    }
    // Whether a path from v meets the frame that one from `back` does. Shading normals seen from behind are replaced
    // (integrators/scattering.h): a Dirac lobe then sends the two along different ways.
    bool is_framed_alike(Scene const& scene, Wavelengths const& wavelengths, Direction const& v) const {
        if (flat_) return true;
        std::optional<Surroundings> const in = beside(scene, v);
        Interaction const other(scene, described(hit_, v, hit_.point.choice), v, wavelengths, in ? &*in : nullptr);
        constexpr float same = 1 - 1e-5f;  // cosine, of unit vectors after rounding
        return std::abs(other.frame.normal.dot(seen_.frame.normal)) > same;
    }
    // (n_v / n_back)^2.
    Lanes squared_index_ratio(Scene const& scene, Wavelengths const& wavelengths, Direction const& v) const {
        Body const* const body = body_at(scene, hit_);
        bool const back_in_front = is_in_front(back_);
        if (!body || back_in_front == is_in_front(v)) return Lanes(1);
        Medium const& outside = in_ ? in_->in_front_of(*body, back_in_front) : body->outside;
        Lanes const ratio = body->inside.n.at(wavelengths) / outside.n.at(wavelengths);
        Lanes const entering = ratio * ratio;
        return back_in_front ? entering : Lanes(1) / entering;
    }

  private:
    static Hit described(Hit met, Direction const& viewer, float choice) {
        describe_meeting(met.point, viewer, choice);
        return met;
    }
    bool is_in_front(Direction const& w) const { return w.dot(hit_.point.geometric_normal) > 0; }
    // Whether closure and frame are those that were made for `back`.
    bool is_seen_alike(Direction const& viewer) const {
        if (viewer == back_) return true;
        Direction const& g = hit_.point.geometric_normal;
        return flat_ && (!two_sided_ || (viewer.dot(g) > 0) == (back_.dot(g) > 0));
    }
    static Scattering evaluate(Interaction const& seen, Direction const& viewer, Direction const& wi) {
        Direction const local = seen.frame.to_local(wi);
        BsdfEvaluation e = seen.bsdf.evaluate(seen.frame.to_local(viewer), local);
        if (!seen.is_consistent(wi, local)) e.value = BsdfValue();
        return {e.value, e.density, std::abs(local.z())};
    }

    Hit hit_;
    Direction back_;
    std::optional<Surroundings> in_;
    Interaction seen_;
    bool flat_, two_sided_;
};

}  // namespace iride
