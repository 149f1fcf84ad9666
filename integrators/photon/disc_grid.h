// SPDX-License-Identifier: Apache-2.0
// Discs of groups, of any radii: those of a group that reach over a point. A disc of radius r is kept once, by its
// centre, in a grid of its octave 2^(l-1) <= r < 2^l, of side 2^(l+1): whatever can reach over p is in the eight cells
// nearest to p of each octave.
#pragma once

#include "integrators/photon/buckets.h"

namespace iride {

class DiscGrid {
  public:
    struct Disc {
        Vector centre;
        float radius;  // [m], > 0
        std::uint32_t group;
        std::uint32_t index;  // the caller's
    };

    DiscGrid() = default;
    explicit DiscGrid(std::vector<Disc> const& discs);

    // visit(disc, distance^2) for distances < radius.
    template <class Visit>
    void visit(Vector const& p, std::uint32_t group, Visit&& visit) const {
        for (int const octave : octaves_) visit_octave(octave, p, group, visit);
    }

  private:
    struct Entry {
        std::uint64_t key;
        Disc disc;
    };
    static float per_side(int octave) { return std::ldexp(1.0f, -octave - 1); }
    static std::uint64_t key(GridCell c, int octave, std::uint32_t group) {
        return c.key(std::uint64_t{group} << 32 | static_cast<std::uint32_t>(octave));
    }
    template <class Visit>
    void visit_octave(int octave, Vector const& p, std::uint32_t group, Visit&& visit) const {
        GridCell const low = GridCell::of(p * per_side(octave) - Vector::Constant(0.5f));
        for (int i = 0; i < 8; ++i) {
            std::uint64_t const wanted = key({low.x + (i & 1), low.y + (i >> 1 & 1), low.z + (i >> 2)}, octave, group);
            for (Entry const& e : entries_.at(wanted)) {
                if (e.key != wanted) continue;
                float const d2 = (e.disc.centre - p).squaredNorm();
                if (d2 < square(e.disc.radius)) visit(e.disc, d2);
            }
        }
    }

    Buckets<Entry> entries_;
    std::vector<int> octaves_;  // that there are discs of
};

}  // namespace iride
