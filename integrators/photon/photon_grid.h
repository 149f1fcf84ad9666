// SPDX-License-Identifier: Apache-2.0
// Points in the cells of a grid, found by a hash of the cell: the nearest ones.
#pragma once

#include "integrators/photon/buckets.h"

namespace iride {

class PhotonGrid {
  public:
    struct Entry {
        Vector position;
        std::uint32_t index;  // as it was given
    };

    PhotonGrid() = default;
    // Cells of side `cell` [m], > 0.
    PhotonGrid(std::vector<Entry> const& entries, float cell);

    std::size_t size() const { return entries_.size(); }
    std::span<Entry const> entries() const { return entries_.all(); }  // those of a cell together

    // The `count` entries nearest to p for which wanted(entry, distance^2), no farther than r. The radius^2 that holds
    // them, the last one on it; fewer: r^2. Found are in `found`, unsorted.
    struct Neighbour {
        float distance2;
        Entry const* entry;
    };
    template <class Wanted>
    float nearest(Vector const& p, float r, std::size_t count, Wanted&& wanted, std::vector<Neighbour>& found) const;

  private:
    GridCell cell_of(Vector const& p) const { return GridCell::of((p - origin_) * per_cell_); }
    template <class Visit>
    void visit_cell(GridCell c, Vector const& p, float r2, Visit&& visit) const {
        for (Entry const& e : entries_.at(c.key())) {
            float const d2 = (e.position - p).squaredNorm();
            if (d2 <= r2 && cell_of(e.position) == c) visit(e, d2);
        }
    }

    Buckets<Entry> entries_;
    Vector origin_{0, 0, 0};
    float cell_ = 1, per_cell_ = 1;
};

template <class Wanted>
float PhotonGrid::nearest(Vector const& p, float r, std::size_t count, Wanted&& wanted,
                          std::vector<Neighbour>& found) const {
    found.clear();
    float limit2 = r * r;
    if (size() == 0 || count == 0) return limit2;
    auto const nearer = [](Neighbour const& a, Neighbour const& b) { return a.distance2 < b.distance2; };
    auto const take = [&](Entry const& e, float d2) {
        if (d2 >= limit2 || !wanted(e, d2)) return;
        if (found.size() == count) {
            std::pop_heap(found.begin(), found.end(), nearer);
            found.pop_back();
        }
        found.push_back({d2, &e});
        std::push_heap(found.begin(), found.end(), nearer);
        if (found.size() == count) limit2 = found.front().distance2;
    };
    // Shell by shell of cells; what lies beyond shell s is at least s cells away.
    GridCell const c = cell_of(p);
    int const shells = static_cast<int>(std::ceil(r * per_cell_));
    for (int s = 0; s <= shells; ++s) {
        if (s > 0 && square(static_cast<float>(s - 1) * cell_) > limit2) break;
        for (int z = -s; z <= s; ++z)
            for (int y = -s; y <= s; ++y) {
                bool const face = std::abs(z) == s || std::abs(y) == s;
                for (int x = -s; x <= s; x += face || s == 0 ? 1 : 2 * s)
                    visit_cell({c.x + x, c.y + y, c.z + z}, p, limit2, take);
            }
    }
    return found.size() == count ? limit2 : r * r;
}

}  // namespace iride
