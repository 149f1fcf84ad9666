// SPDX-License-Identifier: Apache-2.0
// A binary tree over lamps: a lamp is chosen by going down, at each node to the left with probability
// importance(left) / (importance(left) + importance(right)), by one random number that is rescaled on the way. The cost
// grows as the depth. The tree is cut where clusters are least in intensity x solid angle of emission x size: the
// surface area orientation heuristic, with the squared diagonal as size. [Conty 2018] [Pharr 2023, sec. 12.6]
#pragma once

#include <cstdint>
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
        LightCluster cluster;
        int right = -1;  // the left child is the next node; -1: a leaf
        int lamp = -1;
    };
    struct Item {
        LightBounds bounds;
        int lamp;
    };
    void build(std::span<Item> items, int depth, std::uint64_t trail);
    float share_of_left(LightReceiver const& receiver, std::size_t node) const;

    std::vector<Node> nodes_;
    std::vector<std::uint64_t> trail_;  // of each lamp: bit k set where the path turns right at depth k
    int depth_ = 0;
};

}  // namespace iride
