// SPDX-License-Identifier: Apache-2.0
// A tree over lamps, eight children to a node: a lamp is chosen by going down, at each node to a child with probability
// importance / sum of importances, by one random number that is rescaled on the way. The cost grows as the depth; the
// children of a node are evaluated in one register. The tree is made as a binary one, cut where clusters are least in
// intensity x solid angle of emission x size: the surface area orientation heuristic, with the squared diagonal as
// size. A node then takes the costliest of its descendants for children. [Conty 2018] [Pharr 2023, sec. 12.6]
#pragma once

#include <array>
#include <span>
#include <vector>

#include "scene/light_bounds.h"

namespace iride {

class LightTree {
  public:
    LightTree() = default;
    // Lamp i of the tree has bounds[i].
    explicit LightTree(std::span<LightBounds const> bounds);

    bool empty() const { return nodes_.empty(); }
    struct Choice {
        int lamp;  // -1: no lamp can be seen from there
        float probability;
    };
    Choice choose(LightReceiver const& receiver, float u) const;
    // That of choose() for this lamp, along its path.
    float probability(LightReceiver const& receiver, int lamp) const;
    int depth() const { return depth_; }

  private:
    struct Node {
        LightClusters clusters;
        std::array<int, real_lanes> child{};  // >= 0: a node; < 0: lamp -1 - child
    };
    struct Place {
        int node = -1;
        int slot = 0;
    };
    class Builder;

    float probability_of(LightReceiver const& receiver, Place const& place) const;

    std::vector<Node> nodes_;
    std::vector<Place> place_of_node_, place_of_lamp_;  // in the node above; none: -1
    int depth_ = 0;
};

}  // namespace iride
