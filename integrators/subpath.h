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

#include "integrators/meeting.h"

namespace iride {

struct BalanceHeuristic {
    static constexpr bool joins = true;
    static Lanes of(Lanes const& ratio) { return ratio; }
    static float of(float ratio) { return ratio; }
};
struct PowerHeuristic {
    static constexpr bool joins = true;
    static Lanes of(Lanes const& ratio) { return ratio * ratio; }
    static float of(float ratio) { return ratio * ratio; }
};

// Where only the first vertex of a subpath is found from the other side, by light sampling or by the camera, and no
// vertex of a camera path is joined with one of a light path: `near` counts there alone.
template <class Heuristic>
struct WithoutJoins : Heuristic {
    static constexpr bool joins = false;
};

template <class Heuristic>
struct Subpath {
    PathState state;
    Lanes near{}, far{};
    bool first = true;  // of its vertices

    // After a ray of length d that arrives with |cosine| > 0.
    void arrive(float d, float cosine) {
        near *= Heuristic::of(square(d) / cosine);
        far *= Heuristic::of(1 / cosine);
    }
    // What the techniques that leave the last vertices of this subpath to the other side add.
    Lanes others(Lanes const& p_back, Lanes const& p_before) const { return Heuristic::of(p_back) * found(p_before); }
    void go_on(Meeting const& at, BsdfSample const& sample, Direction const& on, Lanes const& p_before) {
        float const per_density = 1 / sample.density->value;
        far = Heuristic::of(at.cosine(on) * per_density) * found(p_before);
        near = Heuristic::of(state.reach * per_density);
        state.reach *= sample.reach;
        first = false;
    }
    void go_on_through_dirac(Meeting const& at, BsdfSample const& sample, Lanes const& squared_index_ratio) {
        far *= Heuristic::of(sample.reach * at.cosine(at.back()) / squared_index_ratio);
        near = Lanes();
        state.reach *= sample.reach;
        first = false;
    }

  private:
    Lanes found(Lanes const& p_before) const {
        if (!Heuristic::joins && !first) return Heuristic::of(p_before) * far;
        return near + Heuristic::of(p_before) * far;
    }
};

}  // namespace iride
