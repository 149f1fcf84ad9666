// SPDX-License-Identifier: Apache-2.0
#include "integrators/photon/disc_grid.h"

#include <algorithm>

namespace iride {

DiscGrid::DiscGrid(std::vector<Disc> const& discs) {
    std::vector<Entry> entries;
    entries.reserve(discs.size());
    for (Disc const& d : discs) {
        int const octave = std::ilogb(d.radius) + 1;
        if (std::ranges::find(octaves_, octave) == octaves_.end()) octaves_.push_back(octave);
        entries.push_back({key(GridCell::of(d.centre * per_side(octave)), octave, d.group), d});
    }
    entries_ = {entries, [](Entry const& e) { return e.key; }};
}

}  // namespace iride
