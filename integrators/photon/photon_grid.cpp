// SPDX-License-Identifier: Apache-2.0
#include "integrators/photon/photon_grid.h"

#include "base/check.h"

namespace iride {

PhotonGrid::PhotonGrid(std::vector<Entry> const& entries, float cell) : cell_(cell), per_cell_(1 / cell) {
    check(cell > 0, "a cell has an extent");
    if (entries.empty()) return;
    origin_ = entries.front().position;
    for (Entry const& e : entries) origin_ = origin_.cwiseMin(e.position);
    entries_ = {entries, [&](Entry const& e) { return cell_of(e.position).key(); }};
}

}  // namespace iride
