// SPDX-License-Identifier: Apache-2.0
// Points in the cells of a grid, found by a hash of the cell: the nearest ones. Built by a counting sort, O(n).
// [Teschner 2003]
#pragma once

#include <cstdint>
#include <vector>

#include "base/random.h"
#include "base/vector.h"

namespace iride {

class PhotonGrid {
  public:
    struct Entry {
        Vector position;
        std::uint32_t group;
        std::uint32_t index;  // as it was given
    };

    PhotonGrid() = default;
    // Cells of side `cell` [m], > 0.
    PhotonGrid(std::vector<Entry> entries, float cell);

    std::size_t size() const { return entry_.size(); }

    // The `count` entries nearest to p for which wanted(entry, distance^2), no farther than r. The radius^2 that holds
    // them, the last one on it; fewer: r^2. Found are in `found`, unsorted.
    struct Neighbour {
        float distance2;
        Entry const* entry;
    };
    template <class Wanted>
    float nearest(Vector const& p, float r, std::size_t count, Wanted&& wanted, std::vector<Neighbour>& found) const;

  private:
    struct Cell {
        int x, y, z;
        friend bool operator==(Cell, Cell) = default;
    };
    Cell cell_of(Vector const& p) const {
        Vector const c = ((p - origin_) * per_cell_).array().floor();
        return {static_cast<int>(c.x()), static_cast<int>(c.y()), static_cast<int>(c.z())};
    }
    std::size_t bucket(Cell c) const {
        auto const word = [](int i) { return static_cast<std::uint64_t>(static_cast<std::uint32_t>(i)); };
        std::uint64_t const key =
            word(c.x) * 0x9e3779b97f4a7c15ull ^ word(c.y) * 0xc2b2ae3d27d4eb4full ^ word(c.z) * 0x165667b19e3779f9ull;
        return static_cast<std::size_t>(mix_bits(key)) & (first_.size() - 2);
    }
    template <class Visit>
    void visit_cell(Cell c, Vector const& p, float r2, Visit&& visit) const {
        std::size_t const b = bucket(c);
        for (std::uint32_t i = first_[b]; i < first_[b + 1]; ++i) {
            Entry const& e = entry_[i];
            float const d2 = (e.position - p).squaredNorm();
            // A bucket may hold entries of another cell.
            if (d2 <= r2 && cell_of(e.position) == c) visit(e, d2);
        }
    }

    std::vector<Entry> entry_;          // by bucket
    std::vector<std::uint32_t> first_;  // [buckets + 1], buckets a power of two
    Vector origin_{0, 0, 0};
    float cell_ = 1, per_cell_ = 1;
};

template <class Wanted>
float PhotonGrid::nearest(Vector const& p, float r, std::size_t count, Wanted&& wanted,
                          std::vector<Neighbour>& found) const {
    found.clear();
    float limit2 = r * r;
    if (entry_.empty() || count == 0) return limit2;
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
    Cell const c = cell_of(p);
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
