// SPDX-License-Identifier: Apache-2.0
// A subpath from the camera or a light, and what the weights of all techniques need of it. A path of given vertices may
// be made by any technique k and with any lane i as hero; with P_k^i its density then, the balance heuristic divides f
// by sum over k of the mean over i of P_k^i. Relative to what was done (technique s, hero h), per lane,
//   P_s^i / P_s^h                  = reach
//   sum_{k<s} P_k^i / P_s^h        = p_back (near + p_before far)
// for the vertices of one subpath, where p_back is the density over area with which its last vertex, p_before the
// density over solid angle with which the one before it, is found from the other side. Going on with density p
// (hero's):
//   far' = |cos| / p (near + p_before far),   near' = reach / p;   through a Dirac lobe of probabilities P
//   far' = |cos_back| (n_back / n_on)^2 P^i / P^h far,   near' = 0
// and at the next hit near is multiplied by d^2 / |cos|, far divided by |cos|. No lane's own density is divided
// by: it may be 0. The power heuristic has the square of every ratio. [Veach 1997, sec. 10.2] [Georgiev 2012]
#pragma once

#include <bit>
#include <cstdint>

#include "integrators/meeting.h"

namespace iride {

struct BalanceHeuristic {
    static constexpr bool joins = true;
    static float shown(float ratio) { return ratio; }
    static Lanes of(Lanes const& ratio) { return ratio; }
    static float of(float ratio) { return ratio; }
};
struct PowerHeuristic {
    static constexpr bool joins = true;
    static float shown(float ratio) { return ratio; }
    static Lanes of(Lanes const& ratio) { return ratio * ratio; }
    static float of(float ratio) { return ratio * ratio; }
};

// Where only the first vertex of a subpath is found from the other side, by light sampling or by the camera, and no
// vertex of a camera path is joined with one of a light path: `near` counts there alone.
template <class Heuristic>
struct WithoutJoins : Heuristic {
    static constexpr bool joins = false;
    // How often the first vertex is shown to the camera, over how often a camera path finds it, as a power of two: both
    // sides weigh by the same number, and neighbours that share what they find mostly do.
    // (integrators/shared_vertices.h)
    static float shown(float ratio) {
        constexpr std::uint32_t half = 0x00400000, exponent = 0xff800000;  // of a float
        return std::bit_cast<float>((std::bit_cast<std::uint32_t>(ratio) + half) & exponent);
    }
};

// What is known of the techniques that leave the last vertices of a subpath to the other side. `reach`: that of the
// subpath before it goes on.
template <class Heuristic>
struct OtherSide {
    Lanes near{}, far{};
    bool first = true;  // of its vertices

    // After a ray of length d that arrives with |cosine| > 0.
    void arrive(float d, float cosine) {
        near *= Heuristic::of(square(d) / cosine);
        far *= Heuristic::of(1 / cosine);
    }
    // What these techniques add. p_before(): asked only where it matters.
    template <class Density>
    Lanes others(Lanes const& p_back, Density&& p_before) const {
        return Heuristic::of(p_back) * found(p_before);
    }
    template <class Density>
    void go_on(float cosine_on, BsdfSample const& sample, Lanes const& reach, Density&& p_before) {
        float const per_density = 1 / sample.density->value;
        far = Heuristic::of(cosine_on * per_density) * found(p_before);
        near = Heuristic::of(reach * per_density);
        first = false;
    }
    void go_on_through_dirac(float cosine_back, BsdfSample const& sample, Lanes const& squared_index_ratio) {
        far *= Heuristic::of(sample.reach * cosine_back / squared_index_ratio);
        near = Lanes();
        first = false;
    }

  private:
    template <class Density>
    Lanes found(Density&& p_before) const {
        Lanes const from_far = is_black(far) ? Lanes() : Heuristic::of(p_before()) * far;
        return Heuristic::joins || first ? near + from_far : from_far;
    }
};

template <class Heuristic>
struct Subpath : OtherSide<Heuristic> {
    PathState state;

    template <class Density>
    void go_on(Meeting const& at, BsdfSample const& sample, Direction const& on, Density&& p_before) {
        OtherSide<Heuristic>::go_on(at.cosine(on), sample, state.reach, p_before);
        state.reach *= sample.reach;
    }
    void go_on_through_dirac(Meeting const& at, BsdfSample const& sample, Lanes const& squared_index_ratio) {
        OtherSide<Heuristic>::go_on_through_dirac(at.cosine(at.back()), sample, squared_index_ratio);
        state.reach *= sample.reach;
    }
};

}  // namespace iride
