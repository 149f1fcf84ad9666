// SPDX-License-Identifier: Apache-2.0
#include "integrators/photon/photon_grid.h"

#include <bit>

#include "base/check.h"

namespace iride {

PhotonGrid::PhotonGrid(std::vector<Entry> entries, float cell) : cell_(cell), per_cell_(1 / cell) {
    check(cell > 0, "a cell has an extent");
    if (entries.empty()) return;
    Vector low = entries.front().position;
    for (Entry const& e : entries) low = low.cwiseMin(e.position);
    origin_ = low;
    first_.assign(std::bit_ceil(entries.size()) + 1, 0);
    std::vector<std::uint32_t> where;
    where.reserve(entries.size());
    for (Entry const& e : entries) {
        where.push_back(static_cast<std::uint32_t>(bucket(cell_of(e.position))));
        ++first_[where.back() + 1];
    }
    for (std::size_t b = 1; b < first_.size(); ++b) first_[b] += first_[b - 1];
    std::vector<std::uint32_t> next(first_.begin(), first_.end() - 1);
    entry_.resize(entries.size());
    for (std::size_t i = 0; i < entries.size(); ++i) entry_[next[where[i]]++] = entries[i];
}

}  // namespace iride
