// SPDX-License-Identifier: Apache-2.0
// Things by the cell of space that they are in, found by a hash of the cell. Built by a counting sort, O(n). A bucket
// may hold things of another cell: who looks has to tell them apart.                                [Teschner 2003]
#pragma once

#include <bit>
#include <cstdint>
#include <span>
#include <vector>

#include "base/random.h"
#include "base/vector.h"

namespace iride {

struct GridCell {
    int x, y, z;
    // The cell of unit side that p is in.
    static GridCell of(Vector const& p) {
        Vector const c = p.array().floor();
        return {static_cast<int>(c.x()), static_cast<int>(c.y()), static_cast<int>(c.z())};
    }
    std::uint64_t key(std::uint64_t salt = 0) const {
        auto const word = [](int i) { return static_cast<std::uint64_t>(static_cast<std::uint32_t>(i)); };
        return mix_bits(word(x) * 0x9e3779b97f4a7c15ull ^ word(y) * 0xc2b2ae3d27d4eb4full ^
                        word(z) * 0x165667b19e3779f9ull ^ salt);
    }
    friend bool operator==(GridCell, GridCell) = default;
};

template <class Thing>
class Buckets {
  public:
    Buckets() = default;
    template <class KeyOf>
    Buckets(std::vector<Thing> const& things, KeyOf&& key_of) : thing_(things.size()) {
        if (things.empty()) return;
        first_.assign(std::bit_ceil(things.size()) + 1, 0);
        std::vector<std::uint32_t> where;
        where.reserve(things.size());
        for (Thing const& t : things) {
            where.push_back(static_cast<std::uint32_t>(bucket(key_of(t))));
            ++first_[where.back() + 1];
        }
        for (std::size_t b = 1; b < first_.size(); ++b) first_[b] += first_[b - 1];
        std::vector<std::uint32_t> next(first_.begin(), first_.end() - 1);
        for (std::size_t i = 0; i < things.size(); ++i) thing_[next[where[i]]++] = things[i];
    }

    std::size_t size() const { return thing_.size(); }
    std::span<Thing const> all() const { return thing_; }  // those of a cell together
    // Not to be asked when there are none.
    std::span<Thing const> at(std::uint64_t key) const {
        std::size_t const b = bucket(key);
        return std::span(thing_).subspan(first_[b], first_[b + 1] - first_[b]);
    }

  private:
    std::size_t bucket(std::uint64_t key) const { return static_cast<std::size_t>(key) & (first_.size() - 2); }

    std::vector<Thing> thing_;          // by bucket
    std::vector<std::uint32_t> first_;  // [buckets + 1], buckets a power of two
};

}  // namespace iride
